#include "core/scene/OutsidePictures.h"

#include "core/document/SceneSource.h"
#include "core/edit/Parameters.h"
#include "core/material/Material.h"

#include <algorithm>

namespace patina {
namespace {

void addOnce(std::vector<std::string>& list, const std::string& text) {
    if (std::find(list.begin(), list.end(), text) == list.end())
        list.push_back(text);
}

// Calls visit(info, material id, slot) for each map that was left out; the document may be changed.
template <class Visit>
void forEachLeftOut(const Document& document, const Visit& visit) {
    std::vector<Id> materials;
    for (const Material& material : document.materials)
        materials.push_back(material.id);
    for (const Id id : materials)
        for (const ParameterInfo& info : parameters()) {
            if (info.scope != Scope::Material || info.type != ParameterType::Map)
                continue;
            const MapSlot slot = std::get<MapSlot>(info.get(document, id));
            if (slot.image == nullptr && slot.problem == kOutsideProblem)
                visit(info, id, slot);
        }
}

} // namespace

OutsidePictures outsidePictures(const Document& document) {
    OutsidePictures result;
    forEachLeftOut(document, [&](const ParameterInfo&, Id material, const MapSlot& slot) {
        addOnce(result.files, slot.source);
        for (const MeshInstance& mesh : document.meshes)
            if (mesh.material == material)
                addOnce(result.models, parseSceneSource(mesh.source).file);
    });
    return result;
}

std::vector<std::string> outsidePicturesOf(const Document& document, const std::string& model) {
    std::vector<std::string> files;
    forEachLeftOut(document, [&](const ParameterInfo&, Id material, const MapSlot& slot) {
        if (std::any_of(
                document.meshes.begin(), document.meshes.end(), [&](const MeshInstance& mesh) {
                    return mesh.material == material && parseSceneSource(mesh.source).file == model;
                }))
            addOnce(files, slot.source);
    });
    return files;
}

void fillOutsidePicture(Document& document, const std::string& source, ColorEncoding encoding,
                        const ImagePtr& image) {
    forEachLeftOut(document, [&](const ParameterInfo& info, Id material, const MapSlot& slot) {
        if (slot.source != source || info.mapEncoding != encoding)
            return;
        MapSlot filled = slot;
        filled.image = image;
        filled.problem.clear();
        info.set(document, material, filled);
    });
}

} // namespace patina
