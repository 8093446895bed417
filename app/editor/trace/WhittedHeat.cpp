#include "app/editor/trace/WhittedHeat.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/trace/PathView.h"
#include "core/image/ColorMap.h"
#include "core/trace/whitted/WhittedTracer.h"

#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

constexpr const char* kHeatTag = "what pixels take";
constexpr int kCoarseHeat = 4;       // of the first counts, so that something is seen soon
constexpr double kBrightest = 0.995; // share of the pixels that the colours span

Result<std::shared_ptr<const WhittedHeat::Counted>>
countRays(const PathView::Frame& frame, const WhittedSettings& settings, bool coarse,
          const std::shared_ptr<const WhittedHeat::Counted>& before, const JobContext& job) {
    auto counted = std::make_shared<WhittedHeat::Counted>();
    TraceView view = frame.view;
    if (coarse) {
        view.width = std::max(1, view.width / kCoarseHeat);
        view.height = std::max(1, view.height / kCoarseHeat);
    }
    counted->coarse = coarse;
    counted->width = view.width;
    counted->height = view.height;
    counted->map = RayCountMap(counted->width, counted->height);
    counted->scene = frame.scene;
    if (before && before->hierarchy && before->scene->geometry() == frame.scene->geometry())
        counted->hierarchy = before->hierarchy;
    else if (frame.scene->geometry() != nullptr)
        counted->hierarchy = std::make_shared<const TeachingHierarchy>(
            TeachingHierarchy::build(*frame.scene->geometry(), job));
    Film film(counted->width, counted->height);
    if (Result<void> traced = traceWhitted(*frame.scene, view, settings, film, 0, 1, job, nullptr,
                                           {}, &counted->map, counted->hierarchy.get());
        !traced)
        return traced.error();
    double rays = 0.0;
    for (const RayCounts& pixel : counted->map.pixels()) {
        rays += pixel.rays;
        counted->boxTests += static_cast<double>(pixel.boxTests);
        counted->triangleTests += static_cast<double>(pixel.triangleTests);
    }
    counted->boxTests /= std::max(rays, 1.0);
    counted->triangleTests /= std::max(rays, 1.0);
    if (const TeachingHierarchy* boxes = counted->hierarchy.get())
        while (counted->deepestLevel + 1 < boxes->levels() &&
               boxes->boxes(counted->deepestLevel + 1).size() <= WhittedHeat::kMostBoxes)
            ++counted->deepestLevel;
    return std::shared_ptr<const WhittedHeat::Counted>(std::move(counted));
}

} // namespace

WhittedHeat::WhittedHeat(DocumentController& controller, PathView& paths, QObject* parent)
    : QObject(parent)
    , m_paths(paths)
    , m_tasks(controller.runner()) {
    connect(&paths, &PathView::changed, this, &WhittedHeat::follow);
}

bool WhittedHeat::isOn() const {
    return m_paths.isWhitted() && (m_shown || m_level);
}

std::shared_ptr<const WhittedHeat::Counted> WhittedHeat::counted() const {
    return m_paths.isWhitted() && m_number == m_paths.number() ? m_counted : nullptr;
}

void WhittedHeat::setShown(std::optional<RayCountKind> shown) {
    if (shown == m_shown)
        return;
    m_shown = shown;
    paint();
    follow();
    Q_EMIT changed();
}

void WhittedHeat::setLevel(std::optional<int> level) {
    if (level == m_level)
        return;
    m_level = level;
    follow();
    Q_EMIT changed();
}

void WhittedHeat::follow() {
    if (!isOn()) {
        m_tasks.cancel(kHeatTag);
        if (!m_paths.isOn() && m_counted) {
            m_counted = nullptr; // and the scene that it holds
            m_picture.reset();
        }
        Q_EMIT changed();
        return;
    }
    const std::optional<PathView::Frame> frame = m_paths.frame();
    const bool begun = counted() != nullptr;
    if (m_tasks.busy(kHeatTag) && m_counting != m_paths.number())
        m_tasks.cancel(kHeatTag); // of a picture that is gone
    if ((begun && !m_counted->coarse) || !frame || !m_paths.progress().refined ||
        m_tasks.busy(kHeatTag)) {
        Q_EMIT changed();
        return;
    }
    m_counting = m_paths.number();
    m_tasks.run(
        {.tag = kHeatTag, .priority = TaskPriority::Low},
        [frame = *frame, settings = m_paths.whitted(), begun, before = m_counted](
            const JobContext& job) { return countRays(frame, settings, !begun, before, job); },
        [this, number = m_paths.number()](const Result<std::shared_ptr<const Counted>>& counted) {
            if (!counted)
                return;
            m_counted = *counted;
            m_number = number;
            paint();
            follow(); // there may be a newer picture
        });
}

void WhittedHeat::paint() {
    m_picture.reset();
    const std::shared_ptr<const Counted> counts = counted();
    if (!counts || !m_shown)
        return;
    const Image image =
        rayCountImage(*m_shown, counts->map, counts->width, counts->height, counts->triangles());
    std::vector<float> sorted(image.f32().begin(), image.f32().end());
    double sum = 0.0;
    for (const float value : sorted)
        sum += static_cast<double>(value);
    const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(
                                           kBrightest * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), last, sorted.end());
    const float most = std::max(*last, 1.0f);
    Picture picture;
    picture.most = static_cast<double>(most);
    picture.mean = sum / static_cast<double>(sorted.size());
    picture.image = QImage(counts->width, counts->height, QImage::Format_RGB32);
    for (int y = 0; y < counts->height; ++y)
        for (int x = 0; x < counts->width; ++x) {
            const glm::vec3 color =
                mapColor(ColorMap::Magma, std::min(image.sample(x, y, 0) / most, 1.0f));
            picture.image.setPixelColor(x, y, QColor::fromRgbF(color.r, color.g, color.b));
        }
    m_picture = std::move(picture);
}

std::vector<TeachingHierarchy::Box> WhittedHeat::boxes() const {
    const std::shared_ptr<const Counted> counts = counted();
    if (!counts || !counts->hierarchy || !m_level)
        return {};
    return counts->hierarchy->boxes(std::min(*m_level, counts->deepestLevel));
}

} // namespace patina::editor
