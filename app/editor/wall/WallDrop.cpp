#include "app/editor/wall/WallDrop.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/DropPlan.h"
#include "app/editor/document/QtText.h"
#include "app/editor/document/SourceName.h"
#include "app/editor/wall/WallOverlay.h"
#include "app/editor/wall/WallState.h"
#include "core/document/Document.h"
#include "core/document/EnvironmentTitle.h"
#include "core/edit/EditSession.h"

#include <QCoreApplication>
#include <QPointer>
#include <algorithm>
#include <numeric>
#include <utility>

namespace patina::editor {
namespace {

QString trWallDrop(const char* text) {
    return QCoreApplication::translate("WallDrop", text);
}

} // namespace

WallDrop::WallDrop(WallState& wall, DocumentController& controller, const WallOverlay& overlay)
    : m_wall(wall)
    , m_controller(controller)
    , m_overlay(overlay) {}

Id WallDrop::sharedEnvironment(const std::vector<std::size_t>& cells) const {
    const Id first = m_wall.cells()[cells.front()].shared.environment;
    const bool all = std::ranges::all_of(cells, [&](std::size_t cell) {
        const WallCell& other = m_wall.cells()[cell];
        return other.shared.environment == first &&
               other.own.element(CellElement::Environment) == 0;
    });
    return all && m_controller.document().environment(first) != nullptr ? first : 0;
}

QString WallDrop::lineOf(const WallDropPlan::Part& part) const {
    const QString name = sourceName(part.file);
    if (part.replaces != 0)
        return trWallDrop("Replace the environment %1 by %2")
            .arg(toQString(environmentTitle(*m_controller.document().environment(part.replaces))),
                 name);
    if (part.cells.size() == 1)
        return trWallDrop("Light the cell %1 with %2")
            .arg(captionOf(m_wall.cells()[part.cells.front()]), name);
    if (!part.cells.empty())
        return trWallDrop("Light these %1 cells with %2").arg(part.cells.size()).arg(name);
    return trWallDrop("Add the environment %1 to the scene").arg(name);
}

WallDropPlan WallDrop::plan(const QStringList& files, const QPointF& position) const {
    WallDropPlan plan;
    if (!m_wall.isOn() || m_wall.cells().empty() || !m_overlay.rect().contains(position.toPoint()))
        return plan;
    const QStringList environments = planDrop(files).environments;
    std::vector<std::size_t> cells = m_overlay.layoutOfWall().cellsAt(position);
    if (environments.isEmpty() || environments.size() != files.size() || cells.empty())
        return plan;

    if (const Id replaced = sharedEnvironment(cells)) {
        plan.parts.push_back({environments.first(), replaced, {}});
    } else if (environments.size() == 1) {
        plan.parts.push_back({environments.first(), 0, cells});
    } else {
        if (cells.size() == 1) { // and those that follow
            cells.resize(m_wall.cells().size() - cells.front());
            std::iota(cells.begin(), cells.end(), cells.front());
        }
        cells.resize(std::min(cells.size(), static_cast<std::size_t>(environments.size())));
        for (std::size_t i = 0; i < cells.size(); ++i)
            plan.parts.push_back({environments[static_cast<qsizetype>(i)], 0, {cells[i]}});
    }
    for (auto i = static_cast<qsizetype>(plan.parts.size()); i < environments.size(); ++i)
        plan.parts.push_back({environments[i], 0, {}});
    plan.area = m_overlay.layoutOfWall().areaOf(cells);
    for (const WallDropPlan::Part& part : plan.parts)
        plan.lines << lineOf(part);
    return plan;
}

void WallDrop::drop(const WallDropPlan& plan) {
    using Use = DocumentController::EnvironmentUse;
    for (const WallDropPlan::Part& part : plan.parts) {
        if (part.replaces != 0) {
            m_controller.replaceEnvironment(part.replaces, part.file);
            continue;
        }
        std::vector<WallCell> cells; // the wall may be another one when the file has been read
        for (const std::size_t cell : part.cells)
            cells.push_back(m_wall.cells()[cell]);
        m_controller.addEnvironment(
            part.file, Use::Cells,
            [wall = QPointer(&m_wall), cells, &controller = m_controller,
             scene = m_controller.session().documentNumber()](Id environment) {
                if (wall && controller.session().documentNumber() == scene)
                    wall->setOwnElement(cells, CellElement::Environment, environment);
            });
    }
    if (plan.parts.size() == 1 && plan.parts.front().cells.size() == 1 && !m_wall.enlarged())
        m_wall.setCurrent(plan.parts.front().cells.front());
}

} // namespace patina::editor
