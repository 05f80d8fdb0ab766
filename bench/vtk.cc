// How long VTK takes for the nine primitives of stdlib/primitives.field: vtk SAMPLES RUNS
//
// An implicit function in C++ is sampled on the grid in floats, then contoured by flying edges with linear vertices, in one thread. Prints
// the median of the runs for each, of the thread's own time: evaluating and contouring.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include <vtkFlyingEdges3D.h>
#include <vtkImplicitFunction.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSampleFunction.h>

namespace {

double sq(double a) { return a * a; }
double cube(double a) { return a * a * a; }

double sphere(double x, double y, double z) { return sq(x / 5) + sq(y / 5) + sq(z / 5) - 1; }

double torus(double x, double y, double z)
{
    return sq(sq(x / 4) + sq(y / 4) + sq(z / 4) + 1 - 0.16) - 4 * (sq(x / 4) + sq(y / 4));
}

double crosscap(double x, double y, double z)
{
    return 4 * sq(x / 5) * (sq(x / 5) + sq(y / 5) + sq(z / 5) + z / 5) + sq(y / 5) * (sq(y / 5) + sq(z / 5) - 1);
}

double heart(double x, double y, double z)
{
    return cube(2 * sq(x / 4) + sq(y / 4) + sq(z / 4) - 1) - 0.1 * sq(x / 4) * cube(z / 4) - sq(y / 4) * cube(z / 4);
}

double hunt(double x, double y, double z)
{
    return 4 * cube(sq(x / 1.5) + sq(y / 1.5) + sq(z / 1.5) - 13) + 27 * sq(3 * sq(x / 1.5) + sq(y / 1.5) - 4 * sq(z / 1.5) - 12);
}

double klein(double x, double y, double z)
{
    double a = x / 1.4, b = y / 1.4, c = z / 1.4, q = a * a + b * b + c * c;
    return (q + 2 * b - 1) * (sq(q - 2 * b - 1) - 8 * c * c) + 16 * a * c * (q - 2 * b - 1);
}

double roman(double x, double y, double z)
{
    return sq(x / 10) * sq(y / 10) + sq(y / 10) * sq(z / 10) + sq(z / 10) * sq(x / 10) - (x / 10) * (y / 10) * (z / 10);
}

double tetrahedral(double x, double y, double z)
{
    double q = sq(x / 2) + sq(y / 2) + sq(z / 2);
    return q * q + 8 * (x / 2) * (y / 2) * (z / 2) - 10 * q + 25;
}

double blobby(double x, double y, double z)
{
    double a = sq(x / 2), b = sq(y / 2), c = sq(z / 2);
    return a * a - 5 * a + b * b - 5 * b + c * c - 5 * c + 11.8;
}

using formula = double (*)(double, double, double);

class Function : public vtkImplicitFunction {
public:
    static Function *New();
    vtkTypeMacro(Function, vtkImplicitFunction);
    using vtkImplicitFunction::EvaluateFunction;
    using vtkImplicitFunction::EvaluateGradient;
    double EvaluateFunction(double x[3]) override { return f(x[0], x[1], x[2]); }
    void EvaluateGradient(double[3], double g[3]) override { g[0] = g[1] = g[2] = 0; }
    formula f = sphere;
};
vtkStandardNewMacro(Function);

double seconds()
{
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
}

double median(std::vector<double> times)
{
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

} // namespace

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        formula f;
    } surfaces[] = {{"sphere", sphere}, {"torus", torus}, {"crosscap", crosscap},       {"heart", heart},  {"hunt", hunt},
                    {"klein", klein},   {"roman", roman}, {"tetrahedral", tetrahedral}, {"blobby", blobby}};
    int samples = argc > 1 ? std::atoi(argv[1]) : 256, runs = argc > 2 ? std::atoi(argv[2]) : 5;
    vtkSMPTools::Initialize(1);
    for (const auto &surface : surfaces) {
        std::vector<double> evaluating, contouring;
        vtkIdType triangles = 0;
        for (int i = 0; i < runs; i++) {
            vtkNew<Function> function;
            vtkNew<vtkSampleFunction> sample;
            vtkNew<vtkFlyingEdges3D> contour;
            function->f = surface.f;
            sample->SetImplicitFunction(function);
            sample->SetModelBounds(-7, 7, -7, 7, -7, 7);
            sample->SetSampleDimensions(samples, samples, samples);
            sample->ComputeNormalsOff();
            sample->SetOutputScalarTypeToFloat();
            contour->SetInputConnection(sample->GetOutputPort());
            contour->SetValue(0, 0);
            contour->ComputeNormalsOff();
            contour->ComputeGradientsOff();
            contour->ComputeScalarsOff();
            double begun = seconds();
            sample->Update();
            double sampled = seconds();
            contour->Update();
            contouring.push_back(seconds() - sampled);
            evaluating.push_back(sampled - begun);
            triangles = contour->GetOutput()->GetNumberOfPolys();
        }
        std::printf("%s %lld %.6f %.6f\n", surface.name, static_cast<long long>(triangles), median(evaluating), median(contouring));
    }
}
