#include "core/scene/ProjectSnapshots.h"

#include "core/base/Base64.h"
#include "core/base/Limits.h"
#include "core/document/Snapshot.h"
#include "core/edit/ComparedValue.h"
#include "core/edit/Edit.h"
#include "core/edit/Looks.h"
#include "core/image/Qoi.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"
#include "core/scene/SceneLoader.h"

#include <algorithm>
#include <map>
#include <memory>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace patina::project {
namespace {

// --- An element alone in a document, where the parameter table finds it at once ---

void put(Document& document, const Material& material) {
    document.materials = {material};
}
void put(Document& document, const Light& light) {
    document.lights = {light};
}
void put(Document& document, const MeshInstance& mesh) {
    document.meshes = {mesh};
}
void put(Document& document, const Softbox& softbox) {
    document.environment().softboxes = {softbox};
}
void put(Document& document, const Environment& environment) {
    document.environments = {environment};
    document.mix.first = environment.id;
}

Material& taken(Document& document, const Material&) {
    return document.materials.front();
}
Light& taken(Document& document, const Light&) {
    return document.lights.front();
}
MeshInstance& taken(Document& document, const MeshInstance&) {
    return document.meshes.front();
}
Softbox& taken(Document& document, const Softbox&) {
    return document.environment().softboxes.front();
}
Environment& taken(Document& document, const Environment&) {
    return document.environments.front();
}

constexpr Scope scopeOf(const Material&) {
    return Scope::Material;
}
constexpr Scope scopeOf(const Light&) {
    return Scope::Light;
}
constexpr Scope scopeOf(const MeshInstance&) {
    return Scope::Mesh;
}
constexpr Scope scopeOf(const Softbox&) {
    return Scope::Softbox;
}
constexpr Scope scopeOf(const Environment&) {
    return Scope::Environment;
}

template <class Element>
std::vector<Id> idsIn(const std::vector<Element>& elements) {
    std::vector<Id> ids;
    ids.reserve(elements.size());
    for (const Element& element : elements)
        ids.push_back(element.id);
    return ids;
}

template <class Element>
std::unordered_map<Id, const Element*> byId(const std::vector<Element>& elements) {
    std::unordered_map<Id, const Element*> found;
    for (const Element& element : elements)
        found.emplace(element.id, &element);
    return found;
}

// Lists of elements and of their ids.
struct ListNames {
    const char *elements, *ids;
};
constexpr ListNames kMaterials{"materials", "materialIds"}, kLights{"lights", "lightIds"},
    kEnvironments{"environments", "environmentIds"}, kMeshes{"meshes", "meshIds"},
    kSoftboxes{"softboxes", "softboxIds"};

bool isOfWhole(const ParameterInfo& info, Scope scope, Id id) {
    return info.scope == scope && info.ofScene == (scope == Scope::Environment && id == 0);
}

// --- Writing ---

class LookWriter {
  public:
    LookWriter(const Document& base, const Document& shown, std::string kept,
               const Writing& writing)
        : m_base(base)
        , m_shown(shown)
        , m_kept(std::move(kept))
        , m_writing(writing) {}

    void write(Json& json) const {
        Json view = Json::object();
        values(view, &m_base, m_shown, Scope::View, 0, m_kept + ".view");
        if (sanitizeCamera(m_base.view.camera) != sanitizeCamera(m_shown.view.camera))
            view["camera"] = cameraToJson(m_shown.view.camera);
        add(json, "view", std::move(view), m_kept + ".view");
        Json scene = Json::object();
        values(scene, &m_base, m_shown, Scope::Environment, 0, m_kept + ".scene");
        add(json, "scene", std::move(scene), m_kept + ".scene");
        Json model = Json::object();
        values(model, &m_base, m_shown, Scope::Model, 0, m_kept + ".model");
        add(json, "model", std::move(model), m_kept + ".model");
        list(json, kEnvironments, m_base.environments, m_shown.environments);
        list(json, kMaterials, m_base.materials, m_shown.materials);
        list(json, kLights, m_base.lights, m_shown.lights);
        list(json, kMeshes, m_base.meshes, m_shown.meshes);
    }

  private:
    void add(Json& json, const char* key, Json object, const std::string& kept) const {
        addKept(object, m_writing.document, kept);
        if (!object.empty())
            json[key] = std::move(object);
    }

    // `base` null: all of them.
    void values(Json& json, const Document* base, const Document& shown, Scope scope, Id id,
                const std::string& kept) const {
        for (const ParameterInfo& info : parameters()) {
            if (!isOfWhole(info, scope, id))
                continue;
            const ParameterValue now = withoutPayload(clampToRange(info, info.get(shown, id)));
            if (base != nullptr && withoutPayload(clampToRange(info, info.get(*base, id))) == now)
                continue;
            const std::string key = keyOf(info);
            Json& value = json[key] = parameterToJson(info, now, m_writing.projectFile);
            if (value.is_object())
                addKept(value, m_writing.document, kept + "." + key);
        }
    }

    template <class Element>
    void list(Json& json, const ListNames& names, const std::vector<Element>& base,
              const std::vector<Element>& shown) const {
        if (idsIn(base) != idsIn(shown))
            json[names.ids] = idsIn(shown);
        const auto known = byId(base);
        Json list = Json::array();
        for (const Element& element : shown) {
            const auto found = known.find(element.id);
            const Element* before = found != known.end() ? found->second : nullptr;
            const std::string kept = m_kept + "." + std::to_string(element.id);
            if (before != nullptr && *before == element &&
                m_writing.document.unknownKeys.of(kept) == nullptr)
                continue;
            Json one{{"id", element.id}};
            Document scratch, scratchBase;
            put(scratch, element);
            if (before != nullptr)
                put(scratchBase, *before);
            values(one, before != nullptr ? &scratchBase : nullptr, scratch, scopeOf(element),
                   element.id, kept);
            inside(one, before, element);
            addKept(one, m_writing.document, kept);
            if (one.size() > 1 || before == nullptr)
                list.push_back(std::move(one));
        }
        if (!list.empty())
            json[names.elements] = std::move(list);
    }

    template <class Element>
    void inside(Json&, const Element*, const Element&) const {}
    void inside(Json& json, const Environment* before, const Environment& environment) const {
        list(json, kSoftboxes, before != nullptr ? before->softboxes : std::vector<Softbox>(),
             environment.softboxes);
    }

    const Document& m_base;
    const Document& m_shown;
    std::string m_kept;
    const Writing& m_writing;
};

// --- Reading ---

class LookReader {
  public:
    LookReader(const Document& document, const LookPtr& base, Reading& reading)
        : m_base(base)
        , m_nextId(document.nextId)
        , m_reading(reading) {
        claim(document);
        for (const Snapshot& snapshot : document.snapshots)
            claim(elementsOf(*snapshot.look));
    }

    // No element's id.
    void claimSnapshot(Id id) {
        if (!m_scopes.try_emplace(id, Scope::View).second)
            throw Broken{fmt::format("the id {} is something else's", id)};
    }

    LookPtr read(ObjectReader& object, const std::string& kept) {
        Document shown = elementsOf(*m_base);
        m_kept = kept;
        list(object, kEnvironments, shown.environments, kMaxEnvironments);
        list(object, kMaterials, shown.materials, limits::kMaxMeshes);
        list(object, kLights, shown.lights, limits::kMaxMeshes);
        list(object, kMeshes, shown.meshes, limits::kMaxMeshes);
        if (const auto view = object.find("view")) {
            ObjectReader inner(*view);
            readParameters(inner, shown, Scope::View, 0, m_kept + ".view", m_reading);
            if (const auto camera = inner.find("camera"))
                readCamera(*camera, shown.view.camera, m_kept + ".view.camera", m_reading);
            inner.keepUnknownKeys(m_kept + ".view", m_reading.unknown);
        }
        if (const auto model = object.find("model")) {
            ObjectReader inner(*model);
            readParameters(inner, shown, Scope::Model, 0, m_kept + ".model", m_reading);
            inner.keepUnknownKeys(m_kept + ".model", m_reading.unknown);
        }
        if (const auto scene = object.find("scene"))
            readScene(*scene, shown);
        check(shown);
        return lookOf(shown, m_base.get());
    }

  private:
    // An id is an element's of one kind, in the document and in all looks.
    void claim(Id id, Scope scope) {
        if (m_scopes.try_emplace(id, scope).first->second != scope || id >= m_nextId)
            throw Broken{fmt::format("the id {} is something else's", id)};
    }
    void claim(const Document& document) {
        const auto all = [&](const auto& elements) {
            for (const auto& element : elements)
                claim(element.id, scopeOf(element));
        };
        all(document.materials);
        all(document.lights);
        all(document.meshes);
        all(document.environments);
        for (const Environment& environment : document.environments)
            all(environment.softboxes);
        for (const Snapshot& snapshot : document.snapshots)
            claim(snapshot.id, Scope::View); // no element's
    }

    template <class Element>
    void list(ObjectReader& object, const ListNames& names, std::vector<Element>& elements,
              std::size_t most) {
        std::vector<Id> ids = idsIn(elements);
        if (const auto given = object.find(names.ids)) {
            ids.clear();
            std::unordered_set<Id> once;
            for (const Node& node : readList(*given, most)) {
                ids.push_back(static_cast<Id>(readInteger(node, 1, kMaxId)));
                if (!once.insert(ids.back()).second)
                    fail(node, "an id that nothing else has");
            }
        }
        std::unordered_map<Id, Node> entries;
        if (const auto given = object.find(names.elements))
            for (const Node& node : readList(*given, most)) {
                ObjectReader entry(node);
                const Node id = entry.require("id");
                if (!entries.emplace(static_cast<Id>(readInteger(id, 1, kMaxId)), node).second)
                    fail(id, "an id that nothing else has");
            }
        const auto known = byId(elements);
        std::vector<Element> all;
        all.reserve(ids.size());
        for (const Id id : ids) {
            const auto before = known.find(id);
            const auto entry = entries.find(id);
            if (before == known.end() && entry == entries.end())
                throw Broken{fmt::format("{} {} is described nowhere", names.ids, id)};
            Element element;
            element.id = id;
            if (before != known.end())
                element = *before->second;
            claim(id, scopeOf(element));
            if (entry != entries.end()) {
                read(entry->second, element);
                entries.erase(entry);
            }
            all.push_back(std::move(element));
        }
        if (!entries.empty())
            fail(entries.begin()->second, fmt::format("an element of {}", names.ids));
        elements = std::move(all);
    }

    template <class Element>
    void read(const Node& node, Element& element) {
        ObjectReader object(node);
        static_cast<void>(object.find("id"));
        const std::string kept = m_kept + "." + std::to_string(element.id);
        Document scratch;
        put(scratch, element);
        readParameters(object, scratch, scopeOf(element), element.id, kept, m_reading);
        element = std::move(taken(scratch, element));
        inside(object, element);
        object.keepUnknownKeys(kept, m_reading.unknown);
    }

    template <class Element>
    void inside(ObjectReader&, Element&) {}
    void inside(ObjectReader& object, Environment& environment) {
        list(object, kSoftboxes, environment.softboxes, kMaxSoftboxes);
    }

    // How the scene uses its environments.
    void readScene(const Node& node, Document& shown) {
        ObjectReader object(node);
        for (const ParameterInfo& info : parameters())
            if (isOfWhole(info, Scope::Environment, 0))
                if (const auto value = object.find(keyOf(info)))
                    info.set(shown, 0, readParameter(info, *value, m_kept + ".scene", m_reading));
        object.keepUnknownKeys(m_kept + ".scene", m_reading.unknown);
    }

    static void check(const Document& shown) {
        const auto environments = byId(shown.environments);
        const Id first = shown.mix.first, second = shown.mix.second;
        if (!environments.contains(first) ||
            (second != 0 && (second == first || !environments.contains(second))))
            throw Broken{"its environment is described nowhere"};
        const auto materials = byId(shown.materials);
        for (const MeshInstance& mesh : shown.meshes)
            if (mesh.material != 0 && !materials.contains(mesh.material))
                throw Broken{fmt::format("its material {} is described nowhere", mesh.material)};
    }

    const LookPtr& m_base;
    Id m_nextId;
    Reading& m_reading;
    std::string m_kept;
    std::map<Id, Scope> m_scopes;
};

ImagePtr readPicture(const Node& node) {
    const auto bytes = fromBase64(readText(node));
    auto picture = bytes ? decodeQoi(*bytes, kMaxSnapshotPicture) : std::nullopt;
    if (!picture)
        fail(node, fmt::format("a QOI picture of at most {0} × {0} pixels as Base64",
                               kMaxSnapshotPicture));
    return std::make_shared<const Image>(*std::move(picture));
}

Snapshot readSnapshot(const Node& node, const Document& document, const LookPtr& base,
                      Reading& reading) {
    ObjectReader object(node);
    Snapshot snapshot;
    const Node id = object.require("id");
    snapshot.id = static_cast<Id>(readInteger(id, 1, document.nextId - 1));
    snapshot.name = uniqueSnapshotName(document, readText(object.require("name")));
    if (const auto picture = object.find("picture"))
        snapshot.picture = readPicture(*picture);
    LookReader reader(document, base, reading);
    reader.claimSnapshot(snapshot.id);
    const std::string kept = "snapshot." + std::to_string(snapshot.id);
    snapshot.look = reader.read(object, kept);
    object.keepUnknownKeys(kept, reading.unknown);
    return snapshot;
}

// "materials[2].metallic should be …": what follows is about the project as a whole.
std::string withoutVerdict(std::string message) {
    constexpr std::string_view kVerdict = "; the project is damaged";
    if (message.ends_with(kVerdict))
        message.resize(message.size() - kVerdict.size());
    return message;
}

} // namespace

Json snapshotsToJson(const Writing& writing) {
    const Document& document = writing.document;
    const Document base = elementsOf(*lookOf(document));
    Json list = Json::array();
    for (const Snapshot& snapshot : document.snapshots) {
        const std::string kept = "snapshot." + std::to_string(snapshot.id);
        Json one{{"id", snapshot.id}, {"name", snapshot.name}};
        const Document shown = elementsOf(*snapshot.look);
        LookWriter(base, shown, kept, writing).write(one);
        if (snapshot.picture)
            one["picture"] = toBase64(encodeQoi(*snapshot.picture));
        addKept(one, document, kept);
        list.push_back(std::move(one));
    }
    return list;
}

void readSnapshots(const Node& list, Document& document, Reading& reading,
                   std::vector<std::string>& leftOut) {
    std::vector<Node> nodes;
    try {
        nodes = readList(list, kMaxSnapshots);
    } catch (const Broken& broken) {
        leftOut.push_back(withoutVerdict(broken.message));
        return;
    }
    const LookPtr base = lookOf(document);
    for (const Node& node : nodes) {
        const std::size_t known = reading.unknown.size();
        try {
            document.snapshots.push_back(readSnapshot(node, document, base, reading));
        } catch (const Broken& broken) {
            reading.unknown.resize(known);
            std::string message = withoutVerdict(broken.message);
            if (!message.starts_with(node.key))
                message = node.key + ": " + message;
            leftOut.push_back(std::move(message));
        }
    }
}

void loadSnapshotImages(SceneLoader& loader, Document& document) {
    // The document's images by what they were read from.
    std::map<std::pair<std::string, ColorEncoding>, MapSlot> maps;
    const auto forEach = [](auto& material, const auto& visit) {
        for (const MaterialInputInfo& input : kMaterialInputs)
            visit(input, material.*input.map);
    };
    for (const Material& material : document.materials)
        forEach(material, [&](const MaterialInputInfo& input, const MapSlot& slot) {
            maps.try_emplace({slot.source, input.encoding}, slot);
        });
    // Each material once, however many looks share it.
    std::map<const Material*, std::shared_ptr<const Material>> materials;
    std::vector<const Material*> order;
    std::vector<Material> copies;
    for (const Snapshot& snapshot : document.snapshots)
        for (const auto& material : snapshot.look->materials)
            if (materials.try_emplace(material.get(), nullptr).second) {
                order.push_back(material.get());
                forEach(copies.emplace_back(*material),
                        [&](const MaterialInputInfo& input, MapSlot& slot) {
                            const auto found = maps.find({slot.source, input.encoding});
                            if (slot.source.empty() || found == maps.end())
                                return;
                            slot.image = found->second.image;
                            slot.problem = found->second.problem;
                        });
            }
    loader.loadMaps(copies);
    for (std::size_t i = 0; i < order.size(); ++i)
        materials[order[i]] = std::make_shared<const Material>(std::move(copies[i]));

    std::map<const Environment*, std::shared_ptr<const Environment>> environments;
    std::vector<Environment> read = document.environments;
    for (const Snapshot& snapshot : document.snapshots)
        for (const auto& environment : snapshot.look->environments) {
            if (!environments.try_emplace(environment.get(), nullptr).second)
                continue;
            Environment copy = *environment;
            const auto found = std::ranges::find_if(read, [&](const Environment& other) {
                return other.source == copy.source && other.layout == copy.layout;
            });
            if (found != read.end()) {
                copy.fileImage = found->fileImage;
                copy.problem = found->problem;
            } else if (!loader.cancelled()) {
                loader.loadEnvironmentFile(copy);
                read.push_back(copy);
            }
            environments[environment.get()] = std::make_shared<const Environment>(copy);
        }
    for (Snapshot& snapshot : document.snapshots) {
        auto look = std::make_shared<Look>(*snapshot.look);
        for (auto& material : look->materials)
            material = materials.at(material.get());
        for (auto& environment : look->environments)
            environment = environments.at(environment.get());
        snapshot.look = std::move(look);
    }
}

} // namespace patina::project
