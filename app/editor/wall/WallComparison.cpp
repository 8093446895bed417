#include "app/editor/wall/WallComparison.h"

#include "app/editor/document/QtText.h"
#include "app/editor/wall/WallLayout.h"
#include "app/editor/wall/WallState.h"
#include "core/compare/DifferencePicture.h"
#include "core/compare/Flip.h"

#include <QApplication>
#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

using Measured = WallComparison::Measured;

QImage toQImage(const Image& image) {
    return QImage(image.u8().data(), image.width(), image.height(), 3 * image.width(),
                  QImage::Format_RGB888)
        .copy();
}

// The difference in colours, as `patina compare --difference` shows it.
Result<void> drawMap(Measured& measured, const Image& a, const Image& b, const ErrorMap& flip,
                     CompareMode mode, bool onlyVisible, const JobContext& job) {
    Image values;
    if (mode == CompareMode::Visible) {
        values = flip.values;
        measured.colors = ColorMap::Magma;
    } else {
        const Difference kind = mode == CompareMode::Signed     ? Difference::Signed
                                : mode == CompareMode::Absolute ? Difference::Absolute
                                                                : Difference::Relative;
        Result<ErrorMap> map = differenceMap(a, b, kind, job);
        if (!map)
            return map.error();
        values = std::move(map->values);
        const auto largest = static_cast<float>(map->summary.max);
        measured.to = largest > 0.0f ? largest : 1.0f;
        measured.from = mode == CompareMode::Signed ? -measured.to : 0.0f;
        measured.colors = mode == CompareMode::Signed ? ColorMap::Diverging : ColorMap::Sequential;
    }
    if (onlyVisible)
        hideInvisible(values, flip.values, kVisibleFlip);
    measured.map = toQImage(colorErrors(values, measured.colors, measured.from, measured.to));
    return {};
}

Result<Measured> measureBoth(const Image& a, const Image& b, CompareMode mode, bool onlyVisible,
                             const JobContext& job) {
    Measured measured;
    const Result<ImageMetrics> metrics = compareImages(a, b);
    if (!metrics)
        return metrics.error();
    measured.metrics = *metrics;
    const Result<Flip> flip = computeFlip(a, b, job);
    if (!flip)
        return flip.error();
    measured.flip = flip->error.summary;
    if (mode >= CompareMode::Signed)
        if (Result<void> drawn = drawMap(measured, a, b, flip->error, mode, onlyVisible, job);
            !drawn)
            return drawn.error();
    return measured;
}

} // namespace

WallComparison::WallComparison(WallState& wall, TaskRunner& runner, QObject* parent)
    : SplitModel(parent)
    , m_wall(wall)
    , m_tasks(runner) {
    connect(&wall, &WallState::changed, this, &WallComparison::follow);
    connect(&wall, &WallState::cellsChosen, this, &WallComparison::follow);
    connect(this, &WallComparison::changed, this, &SplitModel::lineChanged);
    connect(&m_flicker, &QTimer::timeout, this, [this] {
        m_turn = !m_turn;
        Q_EMIT changed();
    });
}

bool WallComparison::isOn() const {
    return m_wall.compared().has_value();
}

void WallComparison::follow() {
    m_peeking = m_turn = false;
    runFlicker();
    outdate();
    Q_EMIT changed();
}

void WallComparison::runFlicker() {
    const bool flickers = isOn() && m_mode == CompareMode::Flicker;
    if (flickers && !m_flicker.isActive())
        m_flicker.start(static_cast<int>(1000.0 / m_flickerHz));
    else if (!flickers)
        m_flicker.stop();
}

void WallComparison::setMode(CompareMode mode) {
    if (mode == m_mode)
        return;
    m_mode = mode;
    m_turn = false;
    runFlicker();
    measureAgain();
    Q_EMIT changed();
}

void WallComparison::setBlend(float blend) {
    m_blend = std::clamp(blend, 0.0f, 1.0f);
    Q_EMIT changed();
}

void WallComparison::setFlickerHz(double hz) {
    m_flickerHz = std::clamp(hz, 0.5, 10.0);
    if (m_flicker.isActive())
        m_flicker.setInterval(static_cast<int>(1000.0 / m_flickerHz));
    Q_EMIT changed();
}

void WallComparison::setOnlyVisible(bool only) {
    if (only == m_onlyVisible)
        return;
    m_onlyVisible = only;
    measureAgain();
    Q_EMIT changed();
}

void WallComparison::setPeeking(bool peeking) {
    if (peeking == m_peeking)
        return;
    m_peeking = peeking;
    Q_EMIT changed();
}

WallComparison::Shown WallComparison::shown() const {
    if (!isOn())
        return {};
    if (m_peeking)
        return {true, {}, 1.0f};
    switch (m_mode) {
    case CompareMode::Wipe:
        return {true, m_line, 1.0f};
    case CompareMode::Flicker:
        return {m_turn, {}, 1.0f};
    case CompareMode::Blend:
        return {true, {}, m_blend};
    default:
        return {};
    }
}

// --- Measured ------------------------------------------------------------------------------------

void WallComparison::outdate() {
    m_outdated = true;
    m_a = m_b = nullptr;
    m_tasks.cancelAll();
    if (!m_measured && m_problem.isEmpty())
        return;
    m_measured.reset();
    m_problem.clear();
    Q_EMIT measuredChanged();
}

void WallComparison::measure(Image a, Image b) {
    m_outdated = false;
    m_a = std::make_shared<const Image>(std::move(a));
    m_b = std::make_shared<const Image>(std::move(b));
    measureAgain();
}

void WallComparison::measureAgain() {
    if (!m_a || !m_b)
        return;
    m_tasks.run(
        {.tag = "comparing two cells"},
        [a = m_a, b = m_b, mode = m_mode, only = m_onlyVisible](const JobContext& job) {
            return measureBoth(*a, *b, mode, only, job);
        },
        [this](const Result<Measured>& measured) {
            m_measured = measured ? std::optional(*measured) : std::nullopt;
            m_problem = measured ? QString() : toQString(measured.error().message);
            Q_EMIT measuredChanged();
        });
}

// --- The line of a wipe --------------------------------------------------------------------------

std::optional<render::ViewSplit> WallComparison::line() const {
    const bool wipes = isOn() && m_mode == CompareMode::Wipe && !m_peeking;
    return wipes ? std::optional(m_line) : std::nullopt;
}

void WallComparison::moveLine(const render::ViewSplit& line) {
    m_line.position = line.position;
    m_line.angleDeg = line.angleDeg;
    Q_EMIT changed();
}

void WallComparison::removeLine() {
    m_wall.compareWith(std::nullopt);
}

QString WallComparison::nameOf(std::optional<std::size_t> cell) const {
    return cell && *cell < m_wall.cells().size() ? captionOf(m_wall.cells()[*cell]) : QString();
}

QString WallComparison::leftName() const {
    return nameOf(m_wall.current());
}

QString WallComparison::rightName() const {
    return nameOf(m_wall.compared());
}

QRect WallComparison::area(const QSize& viewport) const {
    const WallLayout layout = WallLayout::of(m_wall, viewport, QFontMetrics(QApplication::font()));
    const auto enlarged = m_wall.enlarged();
    return enlarged ? layout.cells[*enlarged] : QRect({}, viewport);
}

} // namespace patina::editor
