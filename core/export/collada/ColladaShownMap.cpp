#include "core/export/collada/ColladaShownMap.h"

#include "core/export/collada/ColladaElements.h"
#include "core/export/collada/ColladaMaterials.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace patina::collada {
namespace {

constexpr const char* kChanged = "another program has changed it since; bake the scene again";

// The <light_map> of a geometry.
xml_node mapElement(xml_node geometry) {
    for (const xml_node& extra : geometry.children("extra"))
        if (isLightMap(extra))
            for (const xml_node& technique : extra.children("technique"))
                if (std::string_view(technique.attribute("profile").value()) == "Patina" &&
                    technique.child("light_map"))
                    return technique.child("light_map");
    return {};
}

std::string namedFile(xml_node element) {
    return fileNameOf(trimmed(textOf(element)));
}

// Where an <image> names its file: 1.4 in <init_from>, 1.5 in its <ref>.
xml_node sourceOf(xml_node image) {
    const xml_node source = image.child("init_from");
    const xml_node reference = source.child("ref");
    return reference ? reference : source;
}

} // namespace

ColladaLightMap shownMap(const SceneContents& contents) {
    std::set<std::string> pictures, radiances;
    for (std::size_t i = 0; i < contents.places.size(); ++i) {
        const xml_node named = mapElement(contents.places[i].geometry);
        if (!named)
            continue;
        radiances.insert(namedFile(named));
        const int material = contents.instances[i].material;
        pictures.insert(material >= 0
                            ? contents.materials[static_cast<std::size_t>(material)].emissionTexture
                            : std::string());
    }
    if (radiances.size() != 1)
        throw Fault("its surfaces show several light maps; expose the documents that they come "
                    "from anew");
    if (pictures.size() != 1 || pictures.begin()->empty())
        throw Fault(std::string("not all surfaces of its light map show it as their emission any "
                                "more: ") +
                    kChanged);
    return {*pictures.begin(), *radiances.begin()};
}

void renameMap(const Tree& tree, const ColladaLightMap& from, const ColladaLightMap& to) {
    const auto rename = [](xml_node element, const std::string& file, const std::string& other) {
        if (file != other && element && namedFile(element) == file)
            setText(element, uriOf(other));
    };
    for (xml_node node = tree.root(); node; node = nextElement(node, tree.root())) {
        const std::string_view name = node.name();
        if (name == "image")
            rename(sourceOf(node), from.picture, to.picture);
        else if (name == "geometry")
            rename(mapElement(node), from.radiance, to.radiance);
    }
}

} // namespace patina::collada
