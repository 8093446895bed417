#include "app/editor/wall/WallComparison.h"

#include "app/editor/document/QtText.h"
#include "app/editor/wall/WallLayout.h"
#include "app/editor/wall/WallState.h"
#include "core/compare/DifferencePicture.h"
#include "core/compare/Flip.h"
#include "core/io/ImageIO.h"

#include <QApplication>
#include <QFile>
#include <QFileInfo>
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

WallComparison::WallComparison(WallState& wall, TaskRunner& runner, WorkerClient& worker,
                               QObject* parent)
    : SplitModel(parent)
    , m_wall(wall)
    , m_worker(worker)
    , m_tasks(runner)
    , m_reading(runner) {
    connect(&wall, &WallState::changed, this, &WallComparison::follow);
    connect(&wall, &WallState::cellsChosen, this, &WallComparison::follow);
    connect(this, &WallComparison::changed, this, &SplitModel::lineChanged);
    connect(&m_flicker, &QTimer::timeout, this, [this] {
        m_turn = !m_turn;
        Q_EMIT changed();
    });
}

bool WallComparison::isOn() const {
    return m_wall.compared().has_value() || (hasFile() && m_wall.enlarged().has_value());
}

void WallComparison::follow() {
    if (hasFile() && (m_wall.compared() || !m_wall.enlarged()))
        forgetFile();
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

// --- A picture from a file -----------------------------------------------------------------------

QString WallComparison::fileName() const {
    return shownFileName(m_filePath);
}

void WallComparison::forgetFile() {
    m_reading.cancelAll();
    m_filePath.clear();
    m_fileNote.clear();
    m_file = nullptr;
    m_filePicture = {};
    m_fileSettings = {};
}

void WallComparison::setFile(const QString& path) {
    forgetFile();
    if (!path.isEmpty() && m_wall.enlarged()) {
        m_wall.compareWith(std::nullopt);
        m_filePath = path;
        m_fileNote = tr("Reading %1…").arg(fileName());
        m_reading.run(
            {.tag = "picture to compare with", .name = "reading a picture to compare with"},
            [worker = &m_worker, path](const JobContext&) -> Result<ImagePtr> {
                ImageLoadOptions options;
                options.integerEncoding = ColorEncoding::Srgb;
                options.colorOnly = true;
                Result<LoadedImage> loaded = loadImage(
                    *worker, std::filesystem::path(QFile::encodeName(path).toStdString()), options);
                if (!loaded)
                    return loaded.error();
                return std::make_shared<const Image>(std::move(loaded->parts.front().image));
            },
            [this](const Result<ImagePtr>& read) {
                m_file = read ? *read : nullptr;
                m_fileNote = read ? QString()
                                  : tr("%1: %2").arg(fileName(), toQString(read.error().message));
                outdate();
                Q_EMIT measuredChanged();
                Q_EMIT changed();
            });
    }
    m_peeking = m_turn = false;
    runFlicker();
    outdate();
    Q_EMIT changed();
}

bool WallComparison::needsStretch() const {
    return m_file && !m_fileCell.isEmpty() &&
           hasOtherProportions(*m_file, m_fileCell.width(), m_fileCell.height());
}

bool WallComparison::wantsRadiance() const {
    return m_file && isRadiance(*m_file);
}

void WallComparison::setFileSettings(const ReferenceSettings& settings) {
    m_fileSettings = settings;
    outdate();
    Q_EMIT changed();
}

void WallComparison::measureFile(Image displayed, Image radiance, const View& view) {
    if (!m_file)
        return; // it is being read
    m_outdated = false;
    m_fileCell = QSize(displayed.width(), displayed.height());
    auto a = std::make_shared<const Image>(std::move(displayed));
    struct Fitted {
        ImagePtr b;
        QImage picture;
        QString note;
    };
    m_tasks.run(
        {.tag = "comparing two cells"},
        [a, radiance = std::make_shared<const Image>(std::move(radiance)), view, file = m_file,
         settings = m_fileSettings](const JobContext&) -> Result<Fitted> {
            Result<ReferencePicture> made =
                referencePicture(*file, radiance->empty() ? *a : *radiance, view, settings);
            if (!made)
                return made.error();
            auto b = std::make_shared<const Image>(std::move(made->displayed));
            return Fitted{b, toQImage(*b), toQString(made->note)};
        },
        [this, a](const Result<Fitted>& fitted) {
            m_filePicture = fitted ? fitted->picture : QImage();
            m_fileNote = fitted ? fitted->note
                                : tr("%1: %2").arg(fileName(), toQString(fitted.error().message));
            if (fitted) {
                m_a = a;
                m_b = fitted->b;
                measureAgain();
            }
            Q_EMIT measuredChanged();
            Q_EMIT changed();
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
    if (hasFile())
        setFile({});
    m_wall.compareWith(std::nullopt);
}

QString WallComparison::nameOf(std::optional<std::size_t> cell) const {
    return cell && *cell < m_wall.cells().size() ? captionOf(m_wall.cells()[*cell]) : QString();
}

QString WallComparison::leftName() const {
    return nameOf(m_wall.current());
}

QString WallComparison::rightName() const {
    return hasFile() ? fileName() : nameOf(m_wall.compared());
}

QRect WallComparison::area(const QSize& viewport) const {
    const WallLayout layout = WallLayout::of(m_wall, viewport, QFontMetrics(QApplication::font()));
    const auto enlarged = m_wall.enlarged();
    return enlarged ? layout.cells[*enlarged] : QRect({}, viewport);
}

} // namespace patina::editor
