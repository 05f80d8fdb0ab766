// Reads a building model by IfcPlusPlus, and says how many of each kind of product there are, and what they hold: ifc_read FILE.ifc
//
// A line for each kind: `IfcWall 12 34567890.000`, the volume in cubic millimetres, of all extruded solids of their shapes.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <ifcpp/IFC4/include/IfcArbitraryClosedProfileDef.h>
#include <ifcpp/IFC4/include/IfcCartesianPoint.h>
#include <ifcpp/IFC4/include/IfcExtrudedAreaSolid.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcPolyline.h>
#include <ifcpp/IFC4/include/IfcPositiveLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcProduct.h>
#include <ifcpp/IFC4/include/IfcProductRepresentation.h>
#include <ifcpp/IFC4/include/IfcRectangleProfileDef.h>
#include <ifcpp/IFC4/include/IfcRepresentation.h>
#include <ifcpp/IFC4/include/IfcRepresentationItem.h>
#include <ifcpp/model/BuildingModel.h>
#include <ifcpp/reader/ReaderSTEP.h>

static double area_of(const shared_ptr<IfcProfileDef> &profile)
{
    if (auto box = dynamic_pointer_cast<IfcRectangleProfileDef>(profile))
        return box->m_XDim->m_value * box->m_YDim->m_value;
    auto closed = dynamic_pointer_cast<IfcArbitraryClosedProfileDef>(profile);
    auto line = closed ? dynamic_pointer_cast<IfcPolyline>(closed->m_OuterCurve) : nullptr;
    double twice = 0;
    for (size_t i = 0; line && i + 1 < line->m_Points.size(); i++) {
        const auto &a = line->m_Points[i]->m_Coordinates, &b = line->m_Points[i + 1]->m_Coordinates;
        twice += a[0]->m_value * b[1]->m_value - b[0]->m_value * a[1]->m_value;
    }
    return twice / 2;
}

static double volume_of(const shared_ptr<IfcProduct> &product)
{
    double volume = 0;
    if (!product->m_Representation)
        return 0;
    for (const auto &shape : product->m_Representation->m_Representations)
        for (const auto &item : shape->m_Items)
            if (auto solid = dynamic_pointer_cast<IfcExtrudedAreaSolid>(item))
                volume += area_of(solid->m_SweptArea) * solid->m_Depth->m_value;
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
        std::printf("%s %d %.3f\n", kind.first.c_str(), kind.second.first, kind.second.second);
    return kinds.empty();
}
