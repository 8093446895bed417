// The document: everything the user made, as one value. A copy is a snapshot (heavy payloads are
// shared and immutable); everything else in Patina is a view of it.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/document/MeshInstance.h"
#include "core/document/UnknownKeys.h"
#include "core/document/View.h"
#include "core/light/Environment.h"
#include "core/material/ShadingModel.h"

#include <vector>

namespace patina {

struct Light;
struct Material;
struct Snapshot;

struct Document {
    Document(); // with one environment, which lights the scene
    Document(const Document& other);
    Document(Document&& other) noexcept;
    Document& operator=(const Document& other);
    Document& operator=(Document&& other) noexcept;
    ~Document();

    std::vector<MeshInstance> meshes;
    std::vector<Material> materials;
    std::vector<Light> lights;
    std::vector<Environment> environments; // never none
    EnvironmentMix mix;
    ShadingModel model;
    View view;
    std::vector<BakeArtifactPtr> bakes; // at most one of each BakeKind, in their order
    std::vector<Snapshot> snapshots;    // kept looks, in the order they were kept
    Id nextId = 1;
    UnknownKeys unknownKeys; // of its project

    [[nodiscard]] Id takeId() { return nextId++; }
    [[nodiscard]] const Material* material(Id id) const;
    [[nodiscard]] Material* material(Id id);
    [[nodiscard]] const Light* light(Id id) const;
    [[nodiscard]] Light* light(Id id);
    // The one that lights the scene, the first of the mix.
    [[nodiscard]] const Environment& environment() const;
    [[nodiscard]] Environment& environment();
    // The other one of the mix; null: there is none.
    [[nodiscard]] const Environment* secondEnvironment() const;
    [[nodiscard]] Environment* secondEnvironment();
    [[nodiscard]] const Environment* environment(Id id) const; // 0: the one that lights the scene
    [[nodiscard]] Environment* environment(Id id);
    [[nodiscard]] const Softbox* softbox(Id id) const; // of any environment
    [[nodiscard]] Softbox* softbox(Id id);
    [[nodiscard]] const MeshInstance* mesh(Id id) const;
    [[nodiscard]] MeshInstance* mesh(Id id);
    [[nodiscard]] const Snapshot* snapshot(Id id) const;
    [[nodiscard]] Bounds bounds() const;             // of the visible meshes, in the world
    [[nodiscard]] std::size_t triangleCount() const; // visible
    bool operator==(const Document& other) const;
};

} // namespace patina
