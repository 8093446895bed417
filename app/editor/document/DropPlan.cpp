#include "app/editor/document/DropPlan.h"

#include "app/editor/document/FileKinds.h"
#include "app/editor/document/QtText.h"
#include "app/editor/document/SourceName.h"
#include "core/document/Document.h"
#include "core/document/Source.h"
#include "core/edit/MapNames.h"
#include "core/material/Material.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <algorithm>

namespace patina::editor {
namespace {

QString trDrop(const char* text) {
    return QCoreApplication::translate("DropPlan", text);
}

const ParameterInfo* mapOf(const QString& file) {
    return mapForFileName(sourceName(file).toStdString());
}

void assign(DropPlan& plan, const QStringList& images) {
    for (const QString& file : images) {
        const ParameterInfo* map = mapOf(file);
        if (!map && images.size() == 1)
            map = findParameter("material.baseColor.map");
        const bool taken = std::any_of(plan.maps.begin(), plan.maps.end(),
                                       [&](const MapFile& other) { return other.map == map; });
        if (map && !taken)
            plan.maps.push_back({map, file});
        else
            plan.unclear << file;
    }
}

} // namespace

DropPlan planDrop(const QStringList& files) {
    DropPlan plan;
    QStringList images, radiance;
    for (const QString& file : files) {
        if (isBuiltin(file.toStdString())) { // skies alone are dragged: DraggedSources.h
            plan.environments << file;
            continue;
        }
        if (QFileInfo(file).isDir()) {
            plan.folders << file;
            continue;
        }
        switch (fileKind(file)) {
        case FileKind::Project:
            plan.projects << file;
            break;
        case FileKind::Model:
            plan.models << file;
            break;
        case FileKind::Environment:
            radiance << file;
            break;
        case FileKind::Image:
            images << file;
            break;
        case FileKind::DisplayConfig:
            plan.displayConfigs << file;
            break;
        case FileKind::Unknown:
            plan.unknown << file;
            break;
        }
    }
    const bool withImages = !images.isEmpty();
    for (const QString& file : radiance)
        (withImages && mapOf(file) ? images : plan.environments) << file;
    assign(plan, images);
    return plan;
}

QStringList DropPlan::photos() const {
    const bool others = !maps.empty() || !models.isEmpty() || !projects.isEmpty();
    return others || unclear.size() < 2 ? QStringList() : unclear;
}

QStringList DropPlan::lines(const Document& document, Id material) const {
    QStringList result;
    const Material* target = document.material(material);
    for (const MapFile& one : maps)
        result << trDrop("%1 ← %2").arg(toQString(one.map->label), sourceName(one.file));
    if (target && !maps.empty())
        result.prepend(trDrop("Onto the material “%1”:").arg(QString::fromStdString(target->name)));
    const auto add = [&](const char* text, const QStringList& files) {
        for (const QString& file : files)
            result << trDrop(text).arg(sourceName(file));
    };
    add("Open the project %1", projects.mid(0, 1));
    add("Add or open the model %1", models);
    add("Light the scene with %1", environments);
    add("Add the folder %1 to the library", folders);
    add("Show through the OpenColorIO configuration %1", displayConfigs);
    if (const QStringList bracket = photos(); !bracket.isEmpty())
        result
            << trDrop("Make an HDR from %1 photos, if their exposures differ").arg(bracket.size());
    else
        add("Left out, its name says no free map: %1", unclear);
    add("Cannot be read by Patina: %1", unknown);
    return result;
}

QString unclearText(const QStringList& files) {
    QStringList names;
    for (const QString& file : files)
        names << sourceName(file);
    return trDrop(
               "Left out: %1. Of images that are dropped together each goes to the map that its "
               "name "
               "says (color, metallic, roughness, normal, ao, emissive); drop the others on their "
               "slots in the Material dock.")
        .arg(names.join(QStringLiteral(", ")));
}

} // namespace patina::editor
