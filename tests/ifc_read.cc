// Reads a building model by IfcPlusPlus, and says how many of each kind of product there are, and what they hold: ifc_read FILE.ifc
//
// A line for each kind: `IfcWall 12 34567890.000000000`, the volume in cubes of the file's unit, of all solids of their shapes.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <ifcpp/IFC4/include/IfcArbitraryClosedProfileDef.h>
#include <ifcpp/IFC4/include/IfcArbitraryProfileDefWithVoids.h>
#include <ifcpp/IFC4/include/IfcCartesianPoint.h>
#include <ifcpp/IFC4/include/IfcCartesianPointList3D.h>
#include <ifcpp/IFC4/include/IfcCurve.h>
#include <ifcpp/IFC4/include/IfcExtrudedAreaSolid.h>
#include <ifcpp/IFC4/include/IfcIndexedPolygonalFace.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcPolygonalFaceSet.h>
#include <ifcpp/IFC4/include/IfcPolyline.h>
#include <ifcpp/IFC4/include/IfcPositiveInteger.h>
#include <ifcpp/IFC4/include/IfcPositiveLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcProduct.h>
#include <ifcpp/IFC4/include/IfcProductRepresentation.h>
#include <ifcpp/IFC4/include/IfcRectangleProfileDef.h>
#include <ifcpp/IFC4/include/IfcRepresentation.h>
#include <ifcpp/IFC4/include/IfcRepresentationItem.h>
#include <ifcpp/model/BuildingModel.h>
#include <ifcpp/reader/ReaderSTEP.h>

static double area_of(const shared_ptr<IfcCurve> &curve)
{
    double twice = 0;
    auto line = dynamic_pointer_cast<IfcPolyline>(curve);
    for (size_t i = 0; line && i + 1 < line->m_Points.size(); i++) {
        const auto &a = line->m_Points[i]->m_Coordinates, &b = line->m_Points[i + 1]->m_Coordinates;
        twice += a[0]->m_value * b[1]->m_value - b[0]->m_value * a[1]->m_value;
    }
    return std::fabs(twice / 2);
}

static double area_of(const shared_ptr<IfcProfileDef> &profile)
{
    if (auto closed = dynamic_pointer_cast<IfcArbitraryClosedProfileDef>(profile)) {
        double area = area_of(closed->m_OuterCurve);
        if (auto pierced = dynamic_pointer_cast<IfcArbitraryProfileDefWithVoids>(profile))
            for (const auto &hole : pierced->m_InnerCurves)
                area -= area_of(hole);
        return area;
    }
    auto box = dynamic_pointer_cast<IfcRectangleProfileDef>(profile);
    return box ? box->m_XDim->m_value * box->m_YDim->m_value : 0;
}

static double volume_of(const IfcPolygonalFaceSet &set)
{
    double six = 0;
    const auto &points = dynamic_pointer_cast<IfcCartesianPointList3D>(set.m_Coordinates)->m_CoordList;
    auto at = [&](const shared_ptr<IfcPositiveInteger> &number, int k) {
        return points[size_t(number->m_value) - 1][size_t(k % 3)]->m_value - points[0][size_t(k % 3)]->m_value;
    };
    for (const auto &face : set.m_Faces) {
        const auto &ring = face->m_CoordIndex;
        for (size_t i = 1; i + 1 < ring.size(); i++)
            for (int k = 0; k < 3; k++)
                six += at(ring[0], k) * (at(ring[i], k + 1) * at(ring[i + 1], k + 2) - at(ring[i], k + 2) * at(ring[i + 1], k + 1));
    }
    return six / 6;
}

static double volume_of(const shared_ptr<IfcProduct> &product)
{
    double volume = 0;
    if (!product->m_Representation)
        return 0;
    for (const auto &shape : product->m_Representation->m_Representations)
        for (const auto &item : shape->m_Items) {
            if (auto set = dynamic_pointer_cast<IfcPolygonalFaceSet>(item))
                volume += volume_of(*set);
            if (auto solid = dynamic_pointer_cast<IfcExtrudedAreaSolid>(item))
                volume += area_of(solid->m_SweptArea) * solid->m_Depth->m_value;
        }
    return volume;
}

int main(int, char **words)
{
    auto model = shared_ptr<BuildingModel>(new BuildingModel());
    ReaderSTEP reader;
    std::string path = words[1];
    std::ifstream file(path);
    std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    reader.loadModelFromString(text, model);
    std::map<std::string, std::pair<int, double>> kinds;
    for (const auto &entity : model->getMapIfcEntities())
        if (auto product = dynamic_pointer_cast<IfcProduct>(entity.second)) {
            auto &kind = kinds[product->className()];
            kind.first++;
            kind.second += volume_of(product);
        }
    for (const auto &kind : kinds)
        std::printf("%s %d %.9f\n", kind.first.c_str(), kind.second.first, kind.second.second);
    return kinds.empty();
}
