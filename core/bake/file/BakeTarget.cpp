#include "core/bake/file/BakeTarget.h"

#include "core/material/Material.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <set>

namespace patina {
namespace {

constexpr const char* kIndex = "patina:index";
constexpr const char* kMeshHash = "patina:meshHash";
constexpr const char* kTriangleCount = "patina:triangleCount";
constexpr const char* kTransform = "patina:transform";

template <class Element>
std::vector<std::string> namesOf(const std::vector<Element>& elements) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    std::map<std::string, int> lastNumber; // of a name that repeats: lower ones are taken
    for (const Element& element : elements) {
        const std::string base = element.name.empty() ? "unnamed" : element.name;
        std::string name = base;
        if (!taken.insert(name).second) {
            int& number = lastNumber.try_emplace(base, 1).first->second;
            do
                name = fmt::format("{}#{}", base, ++number);
            while (!taken.insert(name).second);
        }
        names.push_back(std::move(name));
    }
    return names;
}

std::map<std::string, std::size_t> indicesOf(const std::vector<std::string>& names) {
    std::map<std::string, std::size_t> indices;
    for (std::size_t i = 0; i < names.size(); ++i)
        indices[names[i]] = i;
    return indices;
}

std::optional<std::size_t> targetOf(const std::map<std::string, std::size_t>& indices,
                                    const BakeAttributes& attributes) {
    if (const std::string* target = findAttribute(attributes, kTargetAttribute))
        if (const auto named = indices.find(*target); named != indices.end())
            return named->second;
    const auto index = numberAttribute(attributes, kIndex, 0, 1 << 30);
    if (!index || static_cast<std::size_t>(*index) >= indices.size())
        return std::nullopt;
    return static_cast<std::size_t>(*index);
}

// The hashes of a mesh's own kinds of numbers: they tell what was changed.
struct Aspect {
    const char* key;
    const char* name;
    Hash (*hash)(const Mesh& mesh);
};

template <auto Member>
Hash hashOf(const Mesh& mesh) {
    return hashBytes(std::as_bytes(std::span(mesh.*Member)));
}

constexpr std::array<Aspect, 5> kAspects = {
    {{"patina:meshHash.positions", "vertices stand elsewhere", hashOf<&Mesh::positions>},
     {"patina:meshHash.indices", "triangles join other vertices", hashOf<&Mesh::indices>},
     {"patina:meshHash.normals", "normals differ", hashOf<&Mesh::normals>},
     {"patina:meshHash.uvs", "texture coordinates differ", hashOf<&Mesh::uvs>},
     {"patina:meshHash.tangents", "tangents differ", hashOf<&Mesh::tangents>}}};

// "a mesh of 482 vertices and 960 triangles"
std::string countsText(std::size_t vertices, std::optional<long long> triangles) {
    std::string text = fmt::format("{} {}", vertices, vertices == 1 ? "vertex" : "vertices");
    if (triangles)
        text += fmt::format(" and {} triangle{}", *triangles, *triangles == 1 ? "" : "s");
    return text;
}

} // namespace

std::vector<std::string> partNames(const std::vector<MeshInstance>& meshes) {
    return namesOf(meshes);
}

std::vector<std::string> partNames(const std::vector<Material>& materials) {
    return namesOf(materials);
}

void describeMesh(const MeshInstance& mesh, const std::string& name, std::size_t index,
                  BakeAttributes& attributes) {
    attributes[kTargetAttribute] = name;
    attributes[kIndex] = std::to_string(index);
    attributes[kMeshHash] = hashMesh(*mesh.mesh).hex();
    attributes[kVertexCountAttribute] = std::to_string(mesh.mesh->vertexCount());
    attributes[kTriangleCount] = std::to_string(mesh.mesh->triangleCount());
    for (const Aspect& aspect : kAspects)
        attributes[aspect.key] = aspect.hash(*mesh.mesh).hex();
    attributes[kTransform] =
        floatsText(std::span(glm::value_ptr(mesh.placement.matrix()), std::size_t{16}));
}

void describeMaterial(const std::string& name, std::size_t index, BakeAttributes& attributes) {
    attributes[kTargetAttribute] = name;
    attributes[kIndex] = std::to_string(index);
}

BakeTargets::BakeTargets(const Document& document)
    : m_document(document)
    , m_meshes(indicesOf(namesOf(document.meshes)))
    , m_materials(indicesOf(namesOf(document.materials))) {}

std::optional<std::size_t> BakeTargets::mesh(const BakeAttributes& attributes) const {
    return targetOf(m_meshes, attributes);
}

std::optional<std::size_t> BakeTargets::material(const BakeAttributes& attributes) const {
    return targetOf(m_materials, attributes);
}

std::string meshMismatch(const BakeTargets& targets, const BakeAttributes& attributes) {
    const Document& document = targets.document();
    const std::string* name = findAttribute(attributes, kTargetAttribute);
    const std::string part = name != nullptr ? *name : "unnamed";
    const std::optional<std::size_t> target = targets.mesh(attributes);
    if (!target)
        return fmt::format("has values for a mesh \"{}\", which the scene does not have", part);
    const MeshInstance& instance = document.meshes[*target];
    if (!instance.mesh)
        return fmt::format("has values for the mesh \"{}\", whose geometry is missing",
                           instance.name);
    const Mesh& mesh = *instance.mesh;
    const std::string* hash = findAttribute(attributes, kMeshHash);
    if (hash != nullptr && *hash == hashMesh(mesh).hex())
        return {};

    const auto vertices = numberAttribute(attributes, kVertexCountAttribute, 0, 1ll << 32);
    const auto triangles = numberAttribute(attributes, kTriangleCount, 0, 1ll << 32);
    const bool otherCounts =
        (vertices && static_cast<std::size_t>(*vertices) != mesh.vertexCount()) ||
        (triangles && static_cast<std::size_t>(*triangles) != mesh.triangleCount());
    if (vertices && otherCounts)
        return fmt::format(
            "was made for a mesh \"{}\" of {}, but \"{}\" here has {}", part,
            countsText(static_cast<std::size_t>(*vertices), triangles), instance.name,
            countsText(mesh.vertexCount(), static_cast<long long>(mesh.triangleCount())));
    std::vector<std::string> differences;
    for (const Aspect& aspect : kAspects)
        if (const std::string* own = findAttribute(attributes, aspect.key);
            own != nullptr && *own != aspect.hash(mesh).hex())
            differences.emplace_back(aspect.name);
    return fmt::format("was made for another mesh \"{}\" with as many vertices{}{}", part,
                       differences.empty() ? "" : ": its ", fmt::join(differences, ", its "));
}

bool sameTransform(const MeshInstance& mesh, const BakeAttributes& attributes) {
    const auto stored = floatsAttribute(attributes, kTransform, 16);
    return !stored ||
           std::equal(stored->begin(), stored->end(), glm::value_ptr(mesh.placement.matrix()));
}

} // namespace patina
