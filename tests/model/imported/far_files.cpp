// SPDX-License-Identifier: MIT
#include "far_files.h"

#include <charconv>
#include <cmath>

#include "core/base/numbers.h"

namespace tspace::test {

namespace {

std::string decimals(double value, const FileStyle& style) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, style.decimals);
    return {text, end.ptr};
}

std::string joined(const DVec3& p, const std::string& between, const FileStyle& style) {
    return decimals(p.x, style) + between + decimals(p.y, style) + between + decimals(p.z, style);
}

std::string stlText(const std::vector<Part>& parts, const FileStyle& style) {
    std::string text;
    for (const Part& part : parts) {
        text += "solid vertex 1 2 3\n";
        for (const std::array<int, 3>& face : part.faces) {
            text += "facet normal 0 0 1\nouter loop\n";
            for (const int i : face)
                text += "vertex " + joined(part.positions[static_cast<std::size_t>(i)], " ", style) + '\n';
            text += "endloop\nendfacet\n";
        }
        text += "endsolid vertex 1 2 3\n";
    }
    return text;
}

std::string collada(const std::vector<Part>& parts, const FileStyle& style) {
    std::string geometries, nodes;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string n = std::to_string(i), count = std::to_string(parts[i].positions.size());
        std::string numbers, corners, place;
        for (const DVec3& p : parts[i].positions) numbers += joined(p, " ", style) + "\n";
        for (const std::array<int, 3>& face : parts[i].faces)
            for (const int corner : face) corners += std::to_string(corner) + ' ';
        geometries += "<geometry id='g" + n + "'><mesh><!-- <float_array id='a" + n + "'> --><source id='p" + n +
                      "'><float_array id='a" + n + "' count='" + std::to_string(3 * parts[i].positions.size()) + "'>" +
                      numbers + "</float_array><technique_common><accessor source='#a" + n + "' count='" + count +
                      "' stride='3'><param name='X' type='float'/><param name='Y' type='float'/>"
                      "<param name='Z' type='float'/></accessor></technique_common></source><vertices id='v" +
                      n + "'><input semantic='POSITION' source='#p" + n + "'/></vertices><triangles count='" +
                      std::to_string(parts[i].faces.size()) + "'><input semantic='VERTEX' source='#v" + n +
                      "' offset='0'/><p>" + corners + "</p></triangles></mesh></geometry>";
        if (const std::optional<DVec3>& t = parts[i].translation; t && style.has_matrices) {
            place = "<matrix>1 0 0 " + decimals(t->x, style) + " 0 1 0 " + decimals(t->y, style) + " 0 0 1 " +
                    decimals(t->z, style) + " 0 0 0 1</matrix>";
        } else if (t) {
            place = "<translate>" + joined(*t, " ", style) + "</translate>";
        }
        nodes += "<node id='n" + n + "'>" + place + "<instance_geometry url='#g" + n + "'/></node>";
    }
    return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
           "<asset><unit meter='" +
           std::string(style.unit) + "'/><up_axis>Y_UP</up_axis></asset><library_geometries>" + geometries +
           "</library_geometries><library_visual_scenes><visual_scene id='s'>" + nodes +
           "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

std::string fbxText(const std::vector<Part>& parts, const FileStyle& style) {
    std::string objects, connections;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string geometry = std::to_string(1000 + i), model = std::to_string(2000 + i);
        std::string numbers, corners;
        for (const DVec3& p : parts[i].positions) numbers += (numbers.empty() ? "" : ",") + joined(p, ",", style);
        for (const std::array<int, 3>& face : parts[i].faces)
            corners += (corners.empty() ? "" : ",") + std::to_string(face[0]) + ',' + std::to_string(face[1]) + ',' +
                       std::to_string(-1 - face[2]);
        objects += "Geometry: " + geometry + ", \"Geometry::g\", \"Mesh\" {\nVertices: *" +
                   std::to_string(3 * parts[i].positions.size()) + " {\n a: " + numbers + "\n}\nPolygonVertexIndex: *" +
                   std::to_string(3 * parts[i].faces.size()) + " {\n a: " + corners + "\n}\n}\nModel: " + model +
                   ", \"Model::m" + std::to_string(i) + "\", \"Mesh\" {\n Version: 232\n";
        if (parts[i].translation)
            objects += "Properties70:  {\n P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\"," +
                       joined(*parts[i].translation, ",", style) + "\n}\n";
        objects += "}\n";
        connections += " C: \"OO\"," + geometry + ',' + model + "\n C: \"OO\"," + model + ",0\n";
    }
    return "; FBX 7.4.0 project file {\nFBXHeaderExtension:  {\n FBXVersion: 7400\n}\n"
           "GlobalSettings:  {\n Properties70:  {\n  P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",100\n }\n}\n"
           "Objects:  {\n" +
           objects + "}\nConnections:  {\n" + connections + "}\n";
}

}  // namespace

Part sheet(int side, const DVec3& place) {
    constexpr double kStep = 0.15;
    Part part;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x)
            part.positions.push_back(place + DVec3{kStep * x, kStep * y, 0.04 * std::sin(0.9 * x) * std::cos(0.7 * y)});
    }
    for (int y = 0; y + 1 < side; ++y) {
        for (int x = 0; x + 1 < side; ++x) {
            const int a = y * side + x;
            part.faces.push_back({a, a + 1, a + side + 1});
            part.faces.push_back({a, a + side + 1, a + side});
        }
    }
    return part;
}

std::string extensionOf(FarFormat format) {
    return format == FarFormat::stlText ? ".stl" : format == FarFormat::collada ? ".dae" : ".fbx";
}

std::string fileOf(FarFormat format, const std::vector<Part>& parts, const FileStyle& style) {
    switch (format) {
        case FarFormat::stlText: return stlText(parts, style);
        case FarFormat::collada: return collada(parts, style);
        case FarFormat::fbxText: return fbxText(parts, style);
    }
    return {};
}

std::string binaryStl(const Part& part) {
    std::string file(80, ' ');
    const auto append = [&](auto value) {
        std::array<std::uint8_t, sizeof value> bytes;
        storeLittleEndian(value, bytes.data());
        file.append(bytes.begin(), bytes.end());
    };
    append(static_cast<std::uint32_t>(part.faces.size()));
    for (const std::array<int, 3>& face : part.faces) {
        for (int k = 0; k < 3; ++k) append(0.0F);
        for (const int i : face) {
            const DVec3& p = part.positions[static_cast<std::size_t>(i)];
            for (const double value : {p.x, p.y, p.z}) append(static_cast<float>(value));
        }
        append(std::uint16_t{0});
    }
    return file;
}

}  // namespace tspace::test
