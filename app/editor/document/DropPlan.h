// What files mean that are dropped together, worked out from their names before anything is read.
#pragma once

#include "core/base/Id.h"
#include "core/edit/Parameters.h"

#include <QString>
#include <QStringList>
#include <vector>

namespace patina {
struct Document;
}

namespace patina::editor {

struct MapFile {
    const ParameterInfo* map = nullptr; // of scope Material
    QString file;
};

struct DropPlan {
    QStringList projects, models, environments, displayConfigs;
    QStringList folders;       // of environments, for the library
    std::vector<MapFile> maps; // each map once
    QStringList unclear;       // images of several whose names say no map, or one that is taken
    QStringList unknown;       // nothing that Patina reads

    // Images that nothing else is meant by, two or more: perhaps a bracket, which their exposures
    // will tell.
    [[nodiscard]] QStringList photos() const;

    // A line for each file, for whoever holds them over the window: "Normal map ← wood_nrm.png";
    // maps are those of `material`.
    [[nodiscard]] QStringList lines(const Document& document, Id material) const;
};

// Images go by plain names to the maps of a material (core/edit/MapNames.h); one alone whose
// name says nothing is its base colour, of several it is left out. Radiance and OpenEXR pictures
// light the scene, unless they come with other images and their names say a map.
// Built-in skies ("builtin:NAME") do, too.
[[nodiscard]] DropPlan planDrop(const QStringList& files);

// "wood.png, wood 2.png: …": why images were left out, and what to do.
[[nodiscard]] QString unclearText(const QStringList& files);

} // namespace patina::editor
