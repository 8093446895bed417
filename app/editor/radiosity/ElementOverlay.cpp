#include "app/editor/radiosity/ElementOverlay.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/radiosity/RadiosityUpdater.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/ViewLines.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/document/Document.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr std::size_t kMostArrows = 10;
constexpr double kWidestArrow = 9.0,
                 kThinnestArrow = 1.2; // pixels, of the largest share and of none
constexpr double kHead = 9.0;          // pixels, of an arrow's head
const QColor kShooter(0xff, 0xd1, 0x66);
constexpr double kWidestLink = 4.0, kThinnestLink = 0.8, kDot = 2.0; // pixels
const QColor kClusterLink(0xff, 0xd1, 0x66), kElementLink(0x7f, 0xd4, 0xff);

} // namespace

ElementOverlay::ElementOverlay(RadiosityUpdater& radiosity, DocumentController& controller,
                               ViewportWidget& viewport)
    : QWidget(&viewport)
    , m_radiosity(radiosity)
    , m_controller(controller)
    , m_viewport(viewport) {
    setObjectName(QStringLiteral("elementOverlay"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    setAccessibleName(tr("Chosen element of the radiosity solution"));
    setGeometry(viewport.rect());
    hide();
    viewport.installEventFilter(this);
    connect(&radiosity, &RadiosityUpdater::changed, this, &ElementOverlay::follow);
    connect(&radiosity, &RadiosityUpdater::shownChanged, this, &ElementOverlay::follow);
    connect(&viewport, &ViewportWidget::frameRendered, this, [this] {
        if (isVisible() && m_camera != m_controller.document().view.camera)
            update();
    });
}

void ElementOverlay::setWanted(bool wanted) {
    m_wanted = wanted;
    follow();
}

bool ElementOverlay::isThere(const std::optional<std::uint32_t>& element) const {
    return element && m_radiosity.live() && *element < m_radiosity.live()->elements().size();
}

void ElementOverlay::follow() {
    m_senders = m_wanted && m_radiosity.isWanted() && isThere(m_radiosity.chosen())
                    ? largestSenders(*m_radiosity.live(), *m_radiosity.solution(),
                                     *m_radiosity.chosen(), kMostArrows)
                    : std::vector<FlowShare>();
    m_links = m_wanted && m_radiosity.isWanted() && isThere(m_radiosity.chosen())
                  ? linksOf(*m_radiosity.live(), *m_radiosity.chosen())
                  : ElementLinks();
    const bool shootsNext = m_radiosity.step() && m_radiosity.step()->next;
    setVisible(m_wanted && m_radiosity.isWanted() && m_radiosity.live() &&
               (m_radiosity.chosen() || shootsNext));
    update();
}

bool ElementOverlay::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize)
        setGeometry(m_viewport.rect());
    const bool picks = m_wanted && m_radiosity.isWanted() && m_radiosity.live();
    if (const auto at = m_click.follow(*event, picks); at && picks)
        choose(*at);
    return false;
}

void ElementOverlay::choose(const QPointF& at) {
    const Camera& camera = m_controller.document().view.camera;
    const glm::vec3 way = ViewLines(camera, m_viewport.size()).direction(at);
    m_radiosity.choose(elementAlong(*m_radiosity.live(), camera.position(), way));
}

// --- Painting ------------------------------------------------------------------------------------

void ElementOverlay::paintOutline(QPainter& painter, const ViewLines& view,
                                  const std::vector<glm::vec3>& corners,
                                  const QColor& color) const {
    QColor halo(tokens::kWell);
    halo.setAlpha(190);
    for (const auto& [pen, width] : {std::pair(halo, 4.5), std::pair(color, 2.0)}) {
        painter.setPen(QPen(pen, width, Qt::SolidLine, Qt::RoundCap));
        for (std::size_t i = 0; i < corners.size(); ++i)
            if (const auto line = view.line(corners[i], corners[(i + 1) % corners.size()]))
                painter.drawLine(*line);
    }
}

void ElementOverlay::paintArrows(QPainter& painter, const ViewLines& view, std::uint32_t element) {
    const glm::vec3 to = elementCentre(*m_radiosity.live(), element);
    QColor halo(tokens::kWell);
    halo.setAlpha(170);
    for (const FlowShare& share : m_senders) {
        if (!share.place)
            continue; // from far away, or from everywhere
        const auto line = view.line(*share.place, to);
        if (!line || line->length() < 1.0)
            continue;
        ++m_arrows;
        const double width = kThinnestArrow + (kWidestArrow - kThinnestArrow) * share.share /
                                                  m_senders.front().share;
        const double most = std::max({share.light.x, share.light.y, share.light.z, 1e-12});
        const auto channel = [most](double value) { // as a display shows it
            return static_cast<int>(255.0 *
                                    std::pow(std::clamp(value / most, 0.0, 1.0), 1.0 / 2.2));
        };
        const QColor color(channel(share.light.x), channel(share.light.y), channel(share.light.z));
        const QPointF along = (line->p2() - line->p1()) / line->length();
        const QPointF across(-along.y(), along.x());
        const double head = std::min(kHead + width, 0.5 * line->length());
        const QPointF neck = line->p2() - head * along;
        QPainterPath tip(line->p2());
        tip.lineTo(neck + 0.5 * head * across);
        tip.lineTo(neck - 0.5 * head * across);
        tip.closeSubpath();
        painter.setPen(QPen(halo, width + 2.5, Qt::SolidLine, Qt::FlatCap));
        painter.drawLine(line->p1(), neck);
        painter.setPen(QPen(color, width, Qt::SolidLine, Qt::FlatCap));
        painter.drawLine(line->p1(), neck);
        painter.setPen(QPen(halo, 1.2));
        painter.setBrush(color);
        painter.drawPath(tip);
    }
}

// A line to each, as wide as its share; clusters end in a ring about what they hold, elements in a
// dot.
void ElementOverlay::paintLinks(QPainter& painter, const ViewLines& view, std::uint32_t element) {
    const glm::vec3 to = elementCentre(*m_radiosity.live(), element);
    const std::size_t count = std::min(m_links.links.size(), kMostLinks);
    for (std::size_t i = count; i-- > 0;) { // the most light on top
        const ElementLink& link = m_links.links[i];
        const bool isCluster = link.element == radiosity::kNone;
        const double most = m_links.links.front().share;
        const double share = most > 0.0 ? link.share / most : 0.0;
        QColor color = isCluster ? kClusterLink : kElementLink;
        color.setAlphaF(static_cast<float>(0.25 + 0.65 * std::sqrt(share)));
        const double width = kThinnestLink + (kWidestLink - kThinnestLink) * share;
        painter.setPen(QPen(color, width, Qt::SolidLine, Qt::RoundCap));
        painter.setBrush(Qt::NoBrush);
        const auto line = view.line(link.centre, to);
        if (!line)
            continue;
        painter.drawLine(*line);
        ++m_drawnLinks;
        const auto middle = view.point(link.centre);
        if (!middle)
            continue;
        if (!isCluster) {
            painter.setBrush(color);
            painter.drawEllipse(*middle, kDot, kDot);
            continue;
        }
        // As large as its sphere is seen.
        if (const auto rim = view.point(link.centre + link.radius * m_camera.up())) {
            painter.setPen(QPen(color, 1.0, Qt::DotLine));
            const double radius = QLineF(*middle, *rim).length();
            painter.drawEllipse(*middle, radius, radius);
        }
    }
}

void ElementOverlay::paintEvent(QPaintEvent*) {
    m_arrows = m_drawnLinks = 0;
    if (!m_radiosity.live())
        return;
    m_camera = m_controller.document().view.camera;
    const ViewLines view(m_camera, size());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    if (const auto& step = m_radiosity.step();
        step && step->next && *step->next < m_radiosity.live()->elements().senderCount())
        paintOutline(painter, view, senderOutline(*m_radiosity.live(), *step->next), kShooter);
    if (!isThere(m_radiosity.chosen()))
        return;
    paintOutline(painter, view, elementOutline(*m_radiosity.live(), *m_radiosity.chosen()),
                 QColor(tokens::kAccent));
    if (m_links.links.empty())
        paintArrows(painter, view, *m_radiosity.chosen());
    else
        paintLinks(painter, view, *m_radiosity.chosen());
}

} // namespace patina::editor
