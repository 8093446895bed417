#include "app/editor/wall/WallState.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "core/edit/EditSession.h"

#include <algorithm>
#include <utility>

namespace patina::editor {

WallState::WallState(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller) {
    connect(&controller, &DocumentController::changed, this, &WallState::follow);
}

void WallState::follow(const Change& change) {
    if (change.isAnotherDocument()) {
        m_planned = false; // what it names is of the document before
        m_own.clear();
        setOn(false);
    } else if (m_on && change.affects != Affects::Nothing) {
        make();
    }
}

void WallState::setOn(bool on) {
    if (on == m_on)
        return;
    m_on = on;
    m_current = m_enlarged = m_compared = std::nullopt;
    if (on && !std::exchange(m_planned, true))
        m_plan = defaultWallPlan(m_controller.document());
    m_wall = {};
    m_cells.clear();
    m_problem.clear();
    if (on)
        make();
    Q_EMIT changed();
}

void WallState::setPlan(const WallPlan& plan) {
    if (plan == m_plan)
        return;
    m_plan = plan;
    m_planned = true;
    m_current = m_enlarged = m_compared = std::nullopt;
    if (m_on)
        make();
    Q_EMIT changed();
}

void WallState::make() {
    const Result<Wall> made = planWall(m_controller.document(), m_plan);
    QString problem = made ? QString() : toQString(made.error().message);
    if (!problem.isEmpty())
        problem[0] = problem[0].toUpper(); // it stands alone
    Wall wall = made ? *made : Wall();
    if (wall == m_wall && problem == m_problem)
        return;
    m_wall = std::move(wall);
    m_problem = problem;
    m_cells = cellsOf(m_wall, m_own);
    m_texts.clear();
    for (std::optional<std::size_t>* cell : {&m_current, &m_enlarged, &m_compared})
        if (*cell && **cell >= m_cells.size())
            cell->reset();
    Q_EMIT changed();
}

void WallState::setCurrent(std::optional<std::size_t> cell) {
    if (cell && *cell >= m_cells.size())
        cell.reset();
    if (cell == m_current)
        return;
    m_current = cell;
    if (m_enlarged)
        m_enlarged = cell;
    if (!m_enlarged || m_compared == m_enlarged)
        m_compared.reset();
    Q_EMIT cellsChosen();
}

void WallState::moveCurrent(int columns, int rows) {
    if (m_cells.empty())
        return;
    if (!m_current) {
        setCurrent(0);
        return;
    }
    const WallCell& from = m_cells[*m_current];
    const auto moved = [](std::size_t at, int by, std::size_t size) {
        const auto most = static_cast<std::ptrdiff_t>(size) - 1;
        return static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(at) + by, 0, most));
    };
    const std::size_t column = moved(from.column, columns, m_wall.width);
    const std::size_t row = moved(from.row, rows, m_wall.height);
    const auto found = std::ranges::find_if(
        m_cells, [&](const WallCell& cell) { return cell.column == column && cell.row == row; });
    if (found != m_cells.end()) // the last row of a grid may be shorter
        setCurrent(static_cast<std::size_t>(found - m_cells.begin()));
}

void WallState::enlarge(std::optional<std::size_t> cell) {
    if (cell && *cell >= m_cells.size())
        cell.reset();
    if (cell == m_enlarged)
        return;
    m_enlarged = cell;
    m_compared.reset();
    if (cell)
        m_current = cell;
    Q_EMIT cellsChosen();
}

void WallState::compareWith(std::optional<std::size_t> cell) {
    if (cell && *cell >= m_cells.size())
        cell.reset();
    const std::size_t shown = m_enlarged.value_or(m_current.value_or(0));
    if (cell == m_compared || cell == shown)
        return;
    if (cell)
        m_current = m_enlarged = shown;
    m_compared = cell;
    Q_EMIT cellsChosen();
}

void WallState::swapCompared() {
    if (!m_compared)
        return;
    m_current = m_enlarged = std::exchange(m_compared, m_enlarged);
    Q_EMIT cellsChosen();
}

void WallState::setOwnElement(const std::vector<WallCell>& cells, CellElement element, Id id) {
    for (const WallCell& cell : cells)
        patina::setOwnElement(m_own, cell, element, id);
    m_cells = cellsOf(m_wall, m_own);
    Q_EMIT ownChanged();
}

void WallState::setOwnValue(const CellEdit& value) {
    if (!m_current)
        return;
    patina::setOwnValue(m_own, m_cells[*m_current], value);
    m_cells = cellsOf(m_wall, m_own);
    Q_EMIT ownChanged();
}

void WallState::linkValue(const Target& target, const ParameterInfo& info) {
    if (!m_current)
        return;
    patina::linkValue(m_own, m_cells[*m_current], target, info);
    m_cells = cellsOf(m_wall, m_own);
    Q_EMIT ownChanged();
}

void WallState::useInScene() {
    if (!m_current)
        return;
    const Cell cell = m_cells[*m_current].cell; // a copy: the wall follows the edits
    putIntoScene(m_controller.session(), cell);
}

void WallState::setTexts(std::vector<QString> texts) {
    if (texts == m_texts)
        return;
    m_texts = std::move(texts);
    Q_EMIT textsChanged();
}

QString WallState::text(std::size_t cell) const {
    return cell < m_texts.size() ? m_texts[cell] : QString();
}

} // namespace patina::editor
