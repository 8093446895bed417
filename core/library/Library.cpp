#include "core/library/Library.h"

#include "core/library/MaterialRecipes.h"
#include "core/library/Meshes.h"
#include "core/library/SkyRecipes.h"
#include "core/material/Material.h"

#include <fmt/format.h>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

namespace patina::library {

namespace {

// What has been made, by name, for as long as somebody uses it. The library's content never
// changes, so that keeping it is no hidden state: a caller cannot tell a cached entry from a new
// one but by the time it takes. No lock is held while an entry is made (making it runs a parallel
// loop, whose waiting thread may pick up a task that asks for the same entry): two threads may make
// the same bytes, the first stays.
template <class Value>
class Cache {
  public:
    using Pointer = std::shared_ptr<const Value>;

    template <class Make>
    Pointer get(const std::string& name, const Make& make) {
        {
            const std::lock_guard lock(m_mutex);
            if (const auto found = m_values.find(name); found != m_values.end())
                if (Pointer used = found->second.lock())
                    return used;
        }
        Pointer made = make();
        if (!made) // it was cancelled
            return nullptr;
        const std::lock_guard lock(m_mutex);
        std::weak_ptr<const Value>& kept = m_values[name];
        if (Pointer used = kept.lock())
            return used;
        kept = made;
        return made;
    }

  private:
    std::mutex m_mutex;
    std::map<std::string, std::weak_ptr<const Value>> m_values;
};

template <class Recipe>
std::vector<Entry> entries(std::span<const Recipe> recipes) {
    std::vector<Entry> result;
    for (const Recipe& recipe : recipes)
        result.push_back({recipe.name, recipe.title, recipe.help});
    return result;
}

template <class Recipe>
const Recipe* find(std::span<const Recipe> recipes, std::string_view name) {
    for (const Recipe& recipe : recipes)
        if (name == recipe.name)
            return &recipe;
    return nullptr;
}

Error unknown(const char* kind, std::string_view name, const std::vector<Entry>& known) {
    std::string names;
    for (const Entry& entry : known)
        names += (names.empty() ? "" : ", ") + entry.name;
    return {ErrorKind::Usage,
            fmt::format("there is no built-in {} '{}'; choose one of: {}", kind, name, names),
            {},
            {}};
}

// Whoever holds one of the maps holds all: they are made together.
SurfaceMaps mapsOf(const MaterialRecipe& recipe) {
    static Cache<SurfaceMaps> cache;
    const auto maps = cache.get(recipe.name, [&] {
        return std::make_shared<const SurfaceMaps>(finishSurface(recipe.make()));
    });
    SurfaceMaps result = *maps;
    for (ImagePtr* map : {&result.baseColor, &result.metallic, &result.perceptualRoughness,
                          &result.normal, &result.occlusion})
        if (*map)
            *map = ImagePtr(maps, map->get());
    return result;
}

} // namespace

const std::vector<Entry>& models() {
    static const std::vector<Entry> list = entries(modelRecipes());
    return list;
}

const std::vector<Entry>& environments() {
    static const std::vector<Entry> list = entries(skyRecipes());
    return list;
}

const std::vector<Entry>& materials() {
    static const std::vector<Entry> list = entries(materialRecipes());
    return list;
}

Room roomOf(const std::string& model) {
    const ModelRecipe* recipe = find(modelRecipes(), model);
    return recipe != nullptr ? recipe->room : Room::None;
}

Result<std::vector<ModelPart>> model(const std::string& name) {
    const ModelRecipe* recipe = find(modelRecipes(), name);
    if (!recipe)
        return unknown("model", name, models());
    static Cache<std::vector<ModelPart>> cache;
    const auto parts = cache.get(
        name, [&] { return std::make_shared<const std::vector<ModelPart>>(recipe->make()); });
    std::vector<ModelPart> result = *parts;
    for (ModelPart& part : result) // whoever holds one of the meshes holds all
        part.mesh = MeshPtr(parts, part.mesh.get());
    return result;
}

Result<ImagePtr> environment(const std::string& name, const JobContext& job) {
    const SkyRecipe* recipe = find(skyRecipes(), name);
    if (!recipe)
        return unknown("environment", name, environments());
    static Cache<Image> cache;
    const ImagePtr sky = cache.get(name, [&] { return recipe->make(recipe->whiteFacingUp, job); });
    if (!sky)
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    return sky;
}

Result<Material> material(const std::string& name) {
    const MaterialRecipe* recipe = find(materialRecipes(), name);
    if (!recipe)
        return unknown("material", name, materials());
    const SurfaceMaps maps = mapsOf(*recipe);
    const auto slot = [&](const char* map, const ImagePtr& image) {
        MapSlot result;
        if (image) {
            result.source = "builtin:" + name + "/" + map;
            result.image = image;
        }
        return result;
    };
    // Maps multiply the numbers: 1 lets them speak for themselves.
    Material m;
    m.name = recipe->title;
    m.baseColor = glm::vec3(1.0f);
    m.baseColorMap = slot("baseColor", maps.baseColor);
    m.metallic = maps.constantMetallic;
    m.metallicMap = slot("metallic", maps.metallic);
    m.perceptualRoughness = 1.0f;
    m.perceptualRoughnessMap = slot("perceptualRoughness", maps.perceptualRoughness);
    m.normalMap = slot("normal", maps.normal);
    m.occlusionMap = slot("occlusion", maps.occlusion);
    return m;
}

Result<ImagePtr> map(const std::string& materialSlashMap) {
    const std::size_t slash = materialSlashMap.find('/');
    const std::string name = materialSlashMap.substr(0, slash);
    const MaterialRecipe* recipe = find(materialRecipes(), name);
    if (!recipe)
        return unknown("material", name, materials());
    const SurfaceMaps maps = mapsOf(*recipe);
    const std::pair<const char*, const ImagePtr*> named[] = {
        {"baseColor", &maps.baseColor},
        {"metallic", &maps.metallic},
        {"perceptualRoughness", &maps.perceptualRoughness},
        {"normal", &maps.normal},
        {"occlusion", &maps.occlusion}};
    const std::string wanted =
        slash == std::string::npos ? std::string() : materialSlashMap.substr(slash + 1);
    std::string names;
    for (const auto& [mapName, image] : named) {
        if (!*image)
            continue;
        if (wanted == mapName)
            return *image;
        names += (names.empty() ? "" : ", ") + name + "/" + mapName;
    }
    return Error{
        ErrorKind::Usage,
        fmt::format("there is no built-in map '{}'; choose one of: {}", materialSlashMap, names),
        {},
        {}};
}

} // namespace patina::library
