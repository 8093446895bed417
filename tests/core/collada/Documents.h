// Small COLLADA documents for tests.
#pragma once

#include "core/export/collada/ColladaDocument.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace patina::test {

inline const std::string kNamespace14 = "http://www.collada.org/2005/11/COLLADASchema";
inline const std::string kNamespace15 = "http://www.collada.org/2008/03/COLLADASchema";

// A square of 1 in the plane z = 0, its front towards +Z, whose primitive element is `primitive`.
inline std::string squareGeometry(const std::string& primitive) {
    return fmt::format(R"(<geometry id="Square" name="Square-mesh"><mesh>
      <source id="Sq-p"><float_array id="Sq-p-a" count="12">0 0 0  1 0 0  1 1 0  0 1 0</float_array>
        <technique_common><accessor source="#Sq-p-a" count="4" stride="3">
          <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
        </accessor></technique_common></source>
      <source id="Sq-n"><float_array id="Sq-n-a" count="3">0 0 1</float_array>
        <technique_common><accessor source="#Sq-n-a" count="1" stride="3">
          <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
        </accessor></technique_common></source>
      <source id="Sq-t"><float_array id="Sq-t-a" count="8">0 0 1 0 1 1 0 1</float_array>
        <technique_common><accessor source="#Sq-t-a" count="4" stride="2">
          <param name="S" type="float"/><param name="T" type="float"/>
        </accessor></technique_common></source>
      <vertices id="Sq-v"><input semantic="POSITION" source="#Sq-p"/></vertices>
      {}
    </mesh></geometry>)",
                       primitive);
}

// Its inputs: position at offset 0, normal at 1, texture coordinate at 2.
inline const std::string kSquareInputs =
    R"(<input semantic="VERTEX" source="#Sq-v" offset="0"/>
       <input semantic="NORMAL" source="#Sq-n" offset="1"/>
       <input semantic="TEXCOORD" source="#Sq-t" offset="2" set="0"/>)";
inline const std::string kSquareAsQuad =
    R"(<polylist count="1" material="sym">)" + kSquareInputs +
    R"(<vcount>4</vcount><p>0 0 0 1 0 1 2 0 2 3 0 3</p></polylist>)";

inline std::string documentOf(const std::string& libraries, const std::string& nodes,
                              const std::string& asset = "<up_axis>Y_UP</up_axis>",
                              const std::string& version = "1.4.1") {
    return fmt::format(R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="{}" version="{}">
  <asset><created>2020-01-01T00:00:00Z</created><modified>2020-01-01T00:00:00Z</modified>{}</asset>
  {}
  <library_visual_scenes><visual_scene id="Scene" name="Scene">{}</visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#Scene"/></scene>
</COLLADA>
)",
                       version.starts_with("1.5") ? kNamespace15 : kNamespace14, version, asset,
                       libraries, nodes);
}

inline std::string squareDocument(const std::string& primitive, const std::string& transform = "") {
    return documentOf("<library_geometries>" + squareGeometry(primitive) + "</library_geometries>",
                      "<node id=\"N\">" + transform +
                          "<instance_geometry url=\"#Square\"/></node>");
}

inline ColladaDocument parsed(const std::string& text) {
    Result<ColladaDocument> document = ColladaDocument::parse(text, "test.dae");
    if (!document)
        throw std::runtime_error(document.error().text());
    return std::move(*document);
}

inline ColladaMesh meshOf(const ColladaDocument& document, std::size_t instance) {
    Result<ColladaMesh> mesh = document.mesh(instance);
    if (!mesh)
        throw std::runtime_error(mesh.error().text());
    return std::move(*mesh);
}

inline ::testing::AssertionResult near(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i)
        if (!(std::abs(a[i] - b[i]) <= 1e-5f))
            return ::testing::AssertionFailure()
                   << a.x << " " << a.y << " " << a.z << " instead of " << b.x << " " << b.y << " "
                   << b.z;
    return ::testing::AssertionSuccess();
}

// Twice the area and the normal of the triangles together.
inline glm::vec3 areaOf(const Mesh& mesh) {
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 &a = mesh.positions[mesh.indices[i]],
                        &b = mesh.positions[mesh.indices[i + 1]],
                        &c = mesh.positions[mesh.indices[i + 2]];
        sum += glm::vec3((b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y),
                         (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z),
                         (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    }
    return sum;
}

// A mesh of the document with a light that says which vertex it is of.
inline ColladaLitMesh litMesh(const ColladaDocument& document, std::size_t instance) {
    ColladaLitMesh lit;
    lit.instance = instance;
    lit.mesh = meshOf(document, instance).mesh;
    for (std::size_t i = 0; i < lit.mesh.positions.size(); ++i) {
        const auto value = static_cast<float>(i) / static_cast<float>(lit.mesh.positions.size());
        lit.colors.emplace_back(value, 0.5f, 0.25f, 1.0f);
        lit.radiosity.emplace_back(10.0f * value, 3.5f, 0.125f);
    }
    return lit;
}

// A room with all that has to survive: two primitives and lines in one geometry, a shared node, a
// skin, a camera, a light, an animation, comments, extras and a namespace of somebody else's.
std::string roomDocument(const std::string& version = "1.4.1");

} // namespace patina::test
