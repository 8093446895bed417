#include "app/editor/radiosity/HemicubeView.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/radiosity/RadiosityTexts.h"
#include "app/editor/radiosity/RadiosityUpdater.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/LabelledField.h"
#include "app/editor/widget/PlotStyle.h"
#include "core/image/ColorMap.h"
#include "core/radiosity/HemicubeFactors.h"
#include "core/radiosity/ParaboloidFactors.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <functional>

namespace patina::editor {

using radiosity::HemicubeCells;
using radiosity::PointFactors;

namespace {

constexpr int kWhole = 2 * HemicubeView::kCells; // pixels along an edge of the cross
constexpr int kHalf = HemicubeView::kCells / 2;
const QColor kOutsideColor(0x10, 0x12, 0x16), kBackColor(0x3c, 0x3c, 0x40);

// Where the cells of a face lie around the top, whose neighbours keep their edges with it.
QPoint pixelOf(HemicubeCells::Face face, int index) {
    const int size = HemicubeView::kCells;
    const int row = index / size, column = index % size;
    const int last = kHalf + size - 1; // of the top, downwards and to the right
    switch (face) {
    case HemicubeCells::Face::Top:
        return {kHalf + column, last - row};
    case HemicubeCells::Face::Right:
        return {last + kHalf - row, last - column};
    case HemicubeCells::Face::Left:
        return {row, last - column};
    case HemicubeCells::Face::Back:
        return {kHalf + column, row};
    case HemicubeCells::Face::Front:
        break;
    }
    return {kHalf + column, last + kHalf - row};
}

// Neighbours in number differ in hue.
QColor hueOf(std::uint32_t element) {
    constexpr double kGolden = 0.61803398875;
    const double turn = std::fmod(kGolden * (element + 1.0), 1.0);
    return QColor::fromHsvF(static_cast<float>(turn), 0.55f, element % 2 == 0 ? 0.85f : 0.68f);
}

QColor displayedLight(const glm::dvec3& light, double most) {
    const auto channel = [most](double value) {
        return static_cast<int>(
            std::lround(255.0 * std::pow(std::clamp(value / most, 0.0, 1.0), 1.0 / 2.2)));
    };
    return {channel(light.x), channel(light.y), channel(light.z)};
}

} // namespace

// The picture, as large as there is room, with whole cells; where the pointer is.
class HemicubeCross : public QWidget {
  public:
    explicit HemicubeCross(const HemicubeView& view)
        : m_view(view) {
        setMouseTracking(true);
        setCursor(Qt::CrossCursor);
        setMinimumSize(140, 110);
        setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    }
    std::function<void(std::optional<QPoint>)> hovered;
    std::function<void(const QPoint&)> pressed;

  protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        paintPlotWell(painter, rect(), {});
        if (m_view.picture().isNull()) {
            paintPlotMessage(painter, rect(), HemicubeView::tr("Click a surface in the viewport."));
            return;
        }
        painter.drawImage(area(), m_view.picture());
        if (m_view.isParaboloid())
            return;
        // Edges of the faces.
        painter.setPen(QPen(QColor(255, 255, 255, 110), 1.0));
        const double cell = area().width() / kWhole;
        painter.drawRect(area().adjusted(kHalf * cell, kHalf * cell, -kHalf * cell, -kHalf * cell));
    }
    void mouseMoveEvent(QMouseEvent* event) override { hovered(pixelAt(event->position())); }
    void leaveEvent(QEvent*) override { hovered(std::nullopt); }
    void mousePressEvent(QMouseEvent* event) override {
        if (const auto pixel = pixelAt(event->position());
            pixel && event->button() == Qt::LeftButton)
            pressed(*pixel);
    }

  private:
    [[nodiscard]] QRectF area() const {
        const double side = std::max(8.0, std::min(width(), height()) - 8.0);
        return {0.5 * (width() - side), 0.5 * (height() - side), side, side};
    }
    [[nodiscard]] std::optional<QPoint> pixelAt(const QPointF& at) const {
        const QPointF in = (at - area().topLeft()) * (kWhole / area().width());
        const QPoint pixel(static_cast<int>(std::floor(in.x())),
                           static_cast<int>(std::floor(in.y())));
        if (!QRect(0, 0, kWhole, kWhole).contains(pixel) || m_view.picture().isNull())
            return std::nullopt;
        return pixel;
    }

    const HemicubeView& m_view;
};

HemicubeView::HemicubeView(RadiosityUpdater& radiosity, DocumentController& controller,
                           QWidget* parent)
    : QWidget(parent)
    , m_radiosity(radiosity)
    , m_controller(controller) {
    m_colors = describe(new QComboBox, tr("Colours of the cells"),
                        tr("Which elements are seen, how bright they are, or how much each cell "
                           "counts"));
    m_colors->setObjectName(QStringLiteral("radiosityHemicubeColors"));
    m_colors->addItems({tr("Elements"), tr("Radiosity"), tr("Delta form factors")});
    m_title = new QLabel;
    m_title->setWordWrap(true);
    m_hover = new QLabel;
    m_hover->setObjectName(QStringLiteral("radiosityHemicubeHover"));
    m_hover->setWordWrap(true);
    m_cross = new HemicubeCross(*this);
    m_cross->setObjectName(QStringLiteral("radiosityHemicube"));
    m_cross->setAccessibleName(tr("What the element sees"));
    m_cross->setToolTip(tr("What the element sees: through the cells of its hemicube, the top in "
                           "the middle and the sides about it, or on its paraboloid map, the "
                           "horizon at the rim; press to choose the element that is seen"));
    m_cross->hovered = [this](std::optional<QPoint> pixel) {
        m_hover->setText(pixel ? wordsAt(*pixel) : QString());
    };
    m_cross->pressed = [this](const QPoint& pixel) {
        if (const auto seen = seenAt(pixel))
            m_radiosity.choose(*seen);
    };
    connect(m_colors, &QComboBox::currentIndexChanged, this, [this] {
        paintPicture();
        m_cross->update();
    });
    auto* top = new QHBoxLayout;
    top->setSpacing(tokens::kGap);
    top->addWidget(labelledField(tr("Colours"), m_colors));
    top->addWidget(m_title, 1);
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(tokens::kGap / 2);
    rows->addLayout(top);
    rows->addWidget(m_cross, 1);
    rows->addWidget(m_hover);
    m_hover->setMinimumHeight(fontMetrics().height());
}

std::optional<std::uint32_t> HemicubeView::sender() const {
    if (!m_radiosity.live())
        return std::nullopt;
    const radiosity::ElementMesh& elements = m_radiosity.live()->elements();
    if (const auto chosen = m_radiosity.chosen())
        return *chosen < elements.size() ? std::optional(elements.senderOf(*chosen)) : std::nullopt;
    const auto& step = m_radiosity.step();
    return step && step->next && *step->next < elements.senderCount() ? step->next : std::nullopt;
}

void HemicubeView::refresh() {
    const auto now = sender();
    if (!now) {
        m_shape = nullptr;
        m_picture = {};
        m_title->setText({});
        m_hover->setText({});
        m_cross->update();
        return;
    }
    const LiveRadiosity& live = *m_radiosity.live();
    if (m_shape != live.shape || m_sender != *now || m_paraboloid != wantsParaboloid())
        see(*now);
    m_title->setText(senderName(m_controller.document(), live, *now));
    paintPicture();
    m_cross->update();
}

bool HemicubeView::wantsParaboloid() const {
    return m_radiosity.live()->settings.factors.method == radiosity::FactorMethod::Paraboloid;
}

void HemicubeView::see(std::uint32_t sender) {
    const LiveRadiosity& live = *m_radiosity.live();
    m_shape = live.shape;
    m_sender = sender;
    m_paraboloid = wantsParaboloid();
    radiosity::FactorSettings settings;
    settings.method =
        m_paraboloid ? radiosity::FactorMethod::Paraboloid : radiosity::FactorMethod::Hemicube;
    settings.resolution = m_paraboloid ? kWhole : kCells;
    settings.seed = live.settings.factors.seed;
    settings.centreOnly = true;
    std::unique_ptr<const PointFactors> factors;
    if (m_paraboloid)
        factors = std::make_unique<radiosity::ParaboloidFactors>(live.elements(),
                                                                 *live.scene->rays(), settings);
    else
        factors = std::make_unique<radiosity::HemicubeFactors>(live.elements(), *live.scene->rays(),
                                                               settings);
    m_seen = factors->seenFromCentre(sender);
    m_factors.assign(factors->weights().begin(), factors->weights().end());
    m_sums.assign(live.elements().size(), 0.0);
    m_outside = m_back = 0.0;
    for (std::size_t cell = 0; cell < m_seen.size(); ++cell)
        (m_seen[cell] == PointFactors::kOutside ? m_outside
         : m_seen[cell] == PointFactors::kBack  ? m_back
                                                : m_sums[m_seen[cell]]) += m_factors[cell];
    m_cells.assign(static_cast<std::size_t>(kWhole) * kWhole, -1);
    if (m_paraboloid)
        placeParaboloid();
    else
        placeHemicube();
}

void HemicubeView::placeHemicube() {
    int first = 0;
    for (const auto face :
         {HemicubeCells::Face::Top, HemicubeCells::Face::Right, HemicubeCells::Face::Left,
          HemicubeCells::Face::Back, HemicubeCells::Face::Front}) {
        const int count = (face == HemicubeCells::Face::Top ? kCells : kHalf) * kCells;
        for (int i = 0; i < count; ++i) {
            const QPoint at = pixelOf(face, i);
            m_cells[static_cast<std::size_t>(at.y() * kWhole + at.x())] = first + i;
        }
        first += count;
    }
}

// A texel is a pixel, the first row at the bottom.
void HemicubeView::placeParaboloid() {
    for (int y = 0; y < kWhole; ++y)
        for (int x = 0; x < kWhole; ++x) {
            const int texel = (kWhole - 1 - y) * kWhole + x;
            if (m_factors[static_cast<std::size_t>(texel)] > 0.0)
                m_cells[static_cast<std::size_t>(y * kWhole + x)] = texel;
        }
}

void HemicubeView::paintPicture() {
    if (!m_shape || !m_radiosity.solution())
        return;
    const LiveRadiosity& live = *m_radiosity.live();
    double brightest = 1e-12, largest = 1e-12;
    const auto lightOf = [&](std::uint32_t e) {
        return live.lit.radiosity(*m_radiosity.solution(), e);
    };
    for (std::uint32_t e = 0; e < m_sums.size(); ++e)
        if (m_sums[e] > 0.0) {
            const glm::dvec3 light = lightOf(e);
            brightest = std::max({brightest, light.x, light.y, light.z});
        }
    for (const double factor : m_factors)
        largest = std::max(largest, factor);
    m_picture = QImage(kWhole, kWhole, QImage::Format_ARGB32);
    m_picture.fill(Qt::transparent);
    for (int y = 0; y < kWhole; ++y)
        for (int x = 0; x < kWhole; ++x) {
            const std::int32_t cell = m_cells[static_cast<std::size_t>(y * kWhole + x)];
            if (cell < 0)
                continue;
            const auto at = static_cast<std::size_t>(cell);
            const std::uint32_t seen = m_seen[at];
            QColor color;
            if (m_colors->currentIndex() == kFactors) {
                const glm::vec3 c =
                    mapColor(ColorMap::Magma, static_cast<float>(m_factors[at] / largest));
                color = QColor::fromRgbF(c.x, c.y, c.z);
            } else if (seen == PointFactors::kOutside) {
                color = kOutsideColor;
            } else if (seen == PointFactors::kBack) {
                color = kBackColor;
            } else if (m_colors->currentIndex() == kRadiosity) {
                color = displayedLight(lightOf(seen), brightest);
            } else {
                color = hueOf(seen);
            }
            m_picture.setPixelColor(x, y, color);
        }
}

std::optional<std::uint32_t> HemicubeView::seenAt(const QPoint& pixel) const {
    const std::int32_t cell = m_cells[static_cast<std::size_t>(pixel.y() * kWhole + pixel.x())];
    if (cell < 0)
        return std::nullopt;
    const std::uint32_t seen = m_seen[static_cast<std::size_t>(cell)];
    return seen < m_sums.size() ? std::optional(seen) : std::nullopt;
}

QString HemicubeView::wordsAt(const QPoint& pixel) const {
    if (m_picture.isNull() || !m_picture.rect().contains(pixel))
        return {};
    const std::int32_t cell = m_cells[static_cast<std::size_t>(pixel.y() * kWhole + pixel.x())];
    if (cell < 0)
        return {};
    const auto at = static_cast<std::size_t>(cell);
    const std::uint32_t seen = m_seen[at];
    const QString what = seen == PointFactors::kOutside ? tr("Outside of the scene")
                         : seen == PointFactors::kBack
                             ? tr("Backs, which absorb")
                             : elementName(m_controller.document(), *m_radiosity.live(), seen);
    const double share = seen == PointFactors::kOutside ? m_outside
                         : seen == PointFactors::kBack  ? m_back
                                                        : m_sums[seen];
    return tr("%1 · this cell %2 · all of its cells %3")
        .arg(what, plotNumber(m_factors[at], 2), flowPercent(share));
}

} // namespace patina::editor
