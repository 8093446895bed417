#include "core/export/collada/ColladaDocument.h"

#include "core/base/AtomicFile.h"
#include "core/base/Check.h"
#include "core/export/collada/ColladaColors.h"
#include "core/export/collada/ColladaGeometry.h"
#include "core/export/collada/ColladaLighting.h"
#include "core/export/collada/ColladaMaterials.h"
#include "core/export/collada/ColladaScene.h"
#include "core/export/collada/ColladaShownMap.h"
#include "core/export/collada/ColladaTree.h"

#include <fmt/format.h>
#include <utility>

namespace patina {

namespace fs = std::filesystem;

struct ColladaDocument::State {
    State(std::string text, fs::path name, const ColladaLimits& limits)
        : tree(std::move(text), limits)
        , file(std::move(name))
        , sceneNodes(collada::visualScenes(tree))
        , scene(collada::namedScene(tree, sceneNodes))
        , contents(collada::readScene(tree, sceneNodes[scene])) {
        for (const collada::xml_node& node : sceneNodes)
            scenes.push_back({node.attribute("id").value(), node.attribute("name").value()});
    }

    [[nodiscard]] Error broken(const collada::Fault& fault) const {
        return {ErrorKind::InputBroken, fault.what(), file, {}};
    }

    collada::Tree tree;
    fs::path file;
    std::vector<collada::xml_node> sceneNodes;
    std::size_t scene = 0;
    collada::SceneContents contents;
    std::vector<VisualScene> scenes;
};

ColladaDocument::ColladaDocument(std::unique_ptr<State> state)
    : m_state(std::move(state)) {}
ColladaDocument::ColladaDocument(ColladaDocument&&) noexcept = default;
ColladaDocument& ColladaDocument::operator=(ColladaDocument&&) noexcept = default;
ColladaDocument::~ColladaDocument() = default;

Result<ColladaDocument> ColladaDocument::read(const fs::path& file, const ColladaLimits& limits) {
    Result<std::string> text = readTextFile(file, limits.fileBytes);
    if (!text)
        return text.error();
    return parse(std::move(*text), file, limits);
}

Result<ColladaDocument> ColladaDocument::parse(std::string text, const fs::path& file,
                                               const ColladaLimits& limits) {
    if (text.size() > limits.fileBytes)
        return Error{ErrorKind::InputBroken,
                     fmt::format("the file is larger than {} bytes; export a part of the scene",
                                 limits.fileBytes),
                     file,
                     {}};
    try {
        return ColladaDocument(std::make_unique<State>(std::move(text), file, limits));
    } catch (const collada::Fault& fault) {
        return Error{ErrorKind::InputBroken, fault.what(), file, {}};
    }
}

const std::vector<VisualScene>& ColladaDocument::scenes() const {
    return m_state->scenes;
}
std::size_t ColladaDocument::scene() const {
    return m_state->scene;
}
const std::vector<ColladaInstance>& ColladaDocument::instances() const {
    return m_state->contents.instances;
}
const std::vector<ColladaMaterial>& ColladaDocument::materials() const {
    return m_state->contents.materials;
}
const std::vector<std::string>& ColladaDocument::notices() const {
    return m_state->contents.notices;
}

Result<void> ColladaDocument::takeScene(std::size_t scene) {
    State& state = *m_state;
    if (scene >= state.sceneNodes.size())
        return Error{ErrorKind::Usage,
                     fmt::format("there is no scene {}; the file has {}", scene + 1,
                                 state.sceneNodes.size()),
                     state.file,
                     {}};
    try {
        state.contents = collada::readScene(state.tree, state.sceneNodes[scene]);
        state.scene = scene;
        return {};
    } catch (const collada::Fault& fault) {
        return state.broken(fault);
    }
}

Result<void> ColladaDocument::takeScene(const std::string& title) {
    if (title.empty())
        return {};
    if (const auto scene = visualScene(scenes(), title))
        return takeScene(*scene);
    return Error{
        ErrorKind::Usage, noSuchVisualScene(visualSceneTitles(scenes()), title), m_state->file, {}};
}

Result<ColladaMesh> ColladaDocument::mesh(std::size_t instance) const {
    const State& state = *m_state;
    CHECK_LT(instance, state.contents.places.size());
    const collada::Place& place = state.contents.places[instance];
    try {
        const collada::xml_node bound =
            collada::boundMaterial(place.element, place.primitive.attribute("material").value());
        ColladaMesh result =
            collada::readMesh(state.tree, place.primitive, collada::textureSet(state.tree, bound),
                              state.contents.instances[instance].toWorld);
        result.mesh.name = state.contents.instances[instance].path;
        return result;
    } catch (const collada::Fault& fault) {
        return state.broken(fault);
    }
}

Result<std::vector<std::string>> ColladaDocument::light(std::span<const ColladaLitMesh> meshes,
                                                        std::chrono::sys_seconds modified,
                                                        const ColladaLightMap* lightMap) {
    State& state = *m_state;
    try {
        if (auto problem =
                collada::problemOf(state.tree, state.contents, meshes, lightMap != nullptr))
            return Error{ErrorKind::Usage, *problem, state.file, {}};
        std::vector<std::string> notices =
            collada::putLight(state.tree, state.contents, meshes, modified, lightMap);
        state.contents = collada::readScene(state.tree, state.sceneNodes[state.scene]);
        return notices;
    } catch (const collada::Fault& fault) {
        return state.broken(fault);
    }
}

bool ColladaDocument::showsLightMap() const {
    return collada::showsLightMap(m_state->contents);
}

Result<ColladaLightMap> ColladaDocument::lightMap() const {
    try {
        return collada::shownMap(m_state->contents);
    } catch (const collada::Fault& fault) {
        return m_state->broken(fault);
    }
}

Result<void> ColladaDocument::renameLightMap(const ColladaLightMap& files) {
    const Result<ColladaLightMap> shown = lightMap();
    if (!shown)
        return shown.error();
    collada::renameMap(m_state->tree, *shown, files);
    return {};
}

Result<std::vector<ColladaLitGeometry>> ColladaDocument::litGeometries() const {
    try {
        return collada::litGeometries(m_state->tree, m_state->contents);
    } catch (const collada::Fault& fault) {
        return m_state->broken(fault);
    }
}

Result<void> ColladaDocument::recolor(std::span<const std::vector<glm::vec4>> colors) {
    try {
        collada::recolor(m_state->tree, m_state->contents, colors);
        return {};
    } catch (const collada::Fault& fault) {
        return m_state->broken(fault);
    }
}

std::string ColladaDocument::text() const {
    return m_state->tree.text();
}

Result<void> ColladaDocument::write(const fs::path& file) const {
    return writeFileAtomically(file, std::string_view(text()));
}

} // namespace patina
