// A COLLADA 1.4 or 1.5 document (.dae), kept whole: what it says about surfaces can be read, baked
// light can be put into it, and everything else (comments, extras, animations, foreign namespaces)
// is written as it was.
//
// Geometry leaves and enters in Patina's conventions (core/mesh/Mesh.h): world space, metres, +Y
// up, texture coordinates from the top. Cameras and lights are preserved, not read.
#pragma once

#include "core/base/Result.h"
#include "core/mesh/Mesh.h"
#include "core/mesh/VisualScenes.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace patina {

// What a damaged or hostile file may not exceed.
struct ColladaLimits {
    std::size_t fileBytes = std::size_t{1} << 30;
    int depth = 512;               // of nested elements, and of nodes through instance_node
    std::size_t nodes = 1000000;   // visited, one that is instanced twice counts twice
    std::size_t elements = 100000; // primitive elements reached: see ColladaInstance
};

// Colours are the file's own numbers; COLLADA does not say how they are encoded, and exporters
// write what their colour buttons show.
struct ColladaMaterial {
    std::string id, name;
    glm::vec3 diffuse{1.0f};    // 1 where there is a texture
    std::string diffuseTexture; // file name or URI, percent signs decoded; empty: none
    glm::vec3 emission{0.0f};   // 1 where there is a texture
    std::string emissionTexture;
    float opacity = 1.0f; // of transparent and transparency, as its mode `opaque` says
    bool doubleSided = false;
    bool unlit = false; // <constant>: its emission (times colours at the vertices) is all it shows
};

// A primitive element (triangles, polylist, polygons, trifans, tristrips) of a geometry, at one of
// the places where the scene shows it.
struct ColladaInstance {
    std::string path;   // names of the nodes down to it: "Room/Table"
    std::string nodeId; // of the innermost node; may be empty
    std::string geometryId, geometryName;
    int primitive = 0; // which of the geometry's primitive elements, lines included
    int material = -1; // of materials(); -1: none is bound
    // Rest geometry of a skin or morph: it is read, but not lit.
    bool controlled = false;
    glm::dmat4 toWorld{1.0}; // of the geometry's own space and units
};

// Without tangents; without texture coordinates where the file has none. Corners with the same
// position, normal and texture coordinate are one vertex. A mirrored instance has its triangles
// turned over, so that fronts stay counter-clockwise.
struct ColladaMesh {
    Mesh mesh;
    std::vector<std::uint32_t> faces; // of each triangle: its polygon, fan or strip in the element
    std::size_t skippedFaces = 0;     // with fewer than three corners
    bool computedNormals = false;     // the file has none
};

// A mesh with light: in world space, as ColladaMesh::mesh; divided as the light needs it.
struct ColladaLitMesh {
    std::size_t instance = 0;         // of instances()
    Mesh mesh;                        // tangents are not used
    std::vector<glm::vec4> colors;    // per vertex, display-encoded, 0…1
    std::vector<glm::vec3> radiosity; // per vertex, linear sRGB, W/m², not negative
    // What the colours show where they are not those of the radiosity, because a texture multiplies
    // them: that of a white surface; of vertices without a texture the radiosity. Empty: nowhere.
    std::vector<glm::vec3> white{};
    // Per vertex, from the top-left corner of a light map, 0…1. Then there are no colours and no
    // radiosity.
    std::vector<glm::vec2> lightMapUvs{};
};

// A picture of the light on all lit meshes, beside the document.
struct ColladaLightMap {
    std::string picture;  // name of its file, as displayed
    std::string radiance; // name of a file with the light itself, linear sRGB, W/(m² sr)
};

// A geometry that has been lit.
struct ColladaLitGeometry {
    std::string id;
    std::vector<glm::vec3> shown; // per vertex: the radiosity that its colours are made of, W/m²
    std::vector<double> areas;    // per vertex: a third of its triangles', m² wherever it is shown
};

class ColladaDocument {
  public:
    // Errors: InputMissing; InputBroken with the element and what to do about it.
    static Result<ColladaDocument> read(const std::filesystem::path& file,
                                        const ColladaLimits& limits = {});
    // `file`: named in errors.
    static Result<ColladaDocument> parse(std::string text, const std::filesystem::path& file,
                                         const ColladaLimits& limits = {});
    ColladaDocument(ColladaDocument&&) noexcept;
    ColladaDocument& operator=(ColladaDocument&&) noexcept;
    ~ColladaDocument();

    [[nodiscard]] const std::vector<VisualScene>& scenes() const; // at least one
    [[nodiscard]] std::size_t scene() const;   // the one <scene> names, else the first, else chosen
    Result<void> takeScene(std::size_t scene); // an error leaves all as it was
    // By its title (core/mesh/VisualScenes.h); empty: stays with the one that is taken.
    Result<void> takeScene(const std::string& title);

    [[nodiscard]] const std::vector<ColladaInstance>& instances() const;
    [[nodiscard]] const std::vector<ColladaMaterial>& materials() const; // of the instances
    // What of the scene is no surface, for the user: splines, lines.
    [[nodiscard]] const std::vector<std::string>& notices() const;

    // Errors: InputBroken (counts, indices, numbers, polygons with holes).
    [[nodiscard]] Result<ColladaMesh> mesh(std::size_t instance) const;

    // Each lit instance gets a <geometry> of its own, whose vertices have the colours as COLOR set
    // 0 and the radiosity in an <extra> of profile "Patina"; a node that is shared is copied. The
    // rest of an instance that is lit in part keeps a geometry without what is lit. Names Patina
    // among the contributors and sets the date. Instances are listed anew: their numbers change.
    // Returns notices: what was left alone, and why. Errors (Usage: a mesh that is not consistent,
    // an instance twice) leave the document as it was.
    // With `lightMap` meshes have a set of texture coordinates for it, and materials of their own:
    // those they had, but black and with the light map as their emission. Such a document cannot be
    // lit again (Usage).
    Result<std::vector<std::string>> light(std::span<const ColladaLitMesh> meshes,
                                           std::chrono::sys_seconds modified,
                                           const ColladaLightMap* lightMap = nullptr);

    [[nodiscard]] bool showsLightMap() const; // of Patina's
    // Its files, beside the document. Errors: InputBroken where surfaces show several, or one of
    // them no longer shows it.
    [[nodiscard]] Result<ColladaLightMap> lightMap() const;
    // Names others instead. Errors: as lightMap().
    Result<void> renameLightMap(const ColladaLightMap& files);
    // Geometries of the scene with light from Patina at their vertices. Errors: InputBroken where
    // light and vertices do not fit together.
    [[nodiscard]] Result<std::vector<ColladaLitGeometry>> litGeometries() const;
    // Gives each of those other colours, one per vertex: display-encoded, 0…1.
    Result<void> recolor(std::span<const std::vector<glm::vec4>> colors);

    // UTF-8, the same bytes each time.
    [[nodiscard]] std::string text() const;
    // Atomically. Errors: CannotCreate, Io.
    [[nodiscard]] Result<void> write(const std::filesystem::path& file) const;

  private:
    struct State;
    explicit ColladaDocument(std::unique_ptr<State> state);
    std::unique_ptr<State> m_state;
};

} // namespace patina
