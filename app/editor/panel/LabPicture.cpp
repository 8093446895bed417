#include "app/editor/panel/LabPicture.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/DirectionAxes.h"
#include "core/image/ColorMap.h"
#include "core/light/Environment.h"
#include "core/light/EnvironmentMapping.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kThumbnailPad = 4; // around a thumbnail
constexpr double kMark = 4.5;    // radius
constexpr double kLabelPad = 6;
constexpr int kFinest = 4096; // pixels that a picture's positions are counted in

EnvironmentMapping mappingOf(LabView view) {
    const bool cube = view.kind == LabKind::Faces;
    return EnvironmentMapping::create(
               cube ? EnvironmentLayout::HorizontalCross : EnvironmentLayout::LatLong,
               cube ? ImageSize{kFinest, kFinest / 4 * 3} : ImageSize{kFinest, kFinest / 2})
        .value();
}

// What of the mapping's picture is shown: all, or a face of the cross.
QRectF windowOf(LabView view, const EnvironmentMapping& mapping) {
    if (!view.isFace())
        return QRectF(0, 0, mapping.size().width, mapping.size().height);
    const LabFace& face = labFace(view.index);
    constexpr int kSide = kFinest / 4;
    return QRectF(face.column * kSide, face.row * kSide, kSide, kSide);
}

// A word on a picture, readable on anything.
void paintLabel(QPainter& painter, const QString& text, const QPointF& topLeft) {
    painter.save();
    painter.setFont(plotFont(painter.font()));
    const QFontMetricsF metrics(painter.font());
    const QRectF label(topLeft,
                       QSizeF(metrics.horizontalAdvance(text) + kLabelPad, metrics.height()));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(0, 0, 0, 120));
    painter.drawRoundedRect(label, 2, 2);
    painter.setPen(QColor(255, 255, 255, 225));
    painter.drawText(label, Qt::AlignCenter, text);
    painter.restore();
}

} // namespace

LabPicture::LabPicture(LabView view, Role role, QWidget* parent)
    : PlotFrame({}, Cursor::Both, Press::Once, parent)
    , m_view(view)
    , m_role(role) {
    setEmptyText(tr("Computing…"));
    fitAxes();
    if (role == Role::Thumbnail) {
        QSizePolicy policy(QSizePolicy::Preferred, QSizePolicy::Preferred);
        policy.setHeightForWidth(true);
        setSizePolicy(policy);
        setFocusPolicy(Qt::ClickFocus);
        QWidget::setCursor(Qt::PointingHandCursor);
    } else {
        setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
        QWidget::setCursor(Qt::CrossCursor);
    }
    connect(this, &PlotFrame::probed, this, [this](const std::optional<QPointF>& place) {
        Q_EMIT pointed(place ? std::optional(labPlace(*place)) : std::nullopt);
    });
}

void LabPicture::fitAxes() {
    if (m_view.isTable())
        setAxes({{tr("N·V"), {}}, {tr("perceptual roughness"), {}}, {tr("value"), {}}});
    else
        setAxes(directionAxes(m_view.isIrradiance() ? PlotAxis{tr("irradiance"), tr(" lx")}
                                                    : PlotAxis{tr("radiance"), tr(" cd/m²")}));
}

void LabPicture::setView(LabView view) {
    m_view = view;
    m_picture = {};
    setProbe(std::nullopt);
    m_lowest.reset();
    fitAxes();
}

void LabPicture::setCaption(const QString& title, const QString& detail, const QString& warning) {
    if (title == m_caption && detail == m_detail && warning == m_warning)
        return;
    m_caption = title;
    m_detail = detail;
    m_warning = warning;
    describe();
    update();
}

void LabPicture::setReason(const QString& message) {
    if (message == m_reason)
        return;
    m_reason = message;
    setMessage(message);
    describe();
}

void LabPicture::setReader(Reader reader) {
    m_reader = std::move(reader);
}

void LabPicture::describe() {
    setAccessibleName(m_role == Role::Stage ? tr("Enlarged: %1").arg(m_caption) : m_caption);
    QStringList parts{m_detail, m_warning, m_reason};
    parts.removeAll(QString());
    setDescription(parts.join(QStringLiteral(", ")));
}

void LabPicture::setPicture(const QImage& picture) {
    m_picture = picture;
    update();
}

void LabPicture::setColorRange(const glm::vec2& range) {
    m_axes[2].min = double{range.x};
    m_axes[2].max = double{range.y};
    update();
}

void LabPicture::setSelected(bool selected) {
    m_selected = selected;
    // One of all is reached with Tab, the others with the arrow keys.
    setFocusPolicy(selected ? Qt::StrongFocus : Qt::ClickFocus);
    update();
}

void LabPicture::setPointer(const std::optional<LabPlace>& place) {
    setProbe(place ? std::optional(placeOf(*place)) : std::nullopt);
}

void LabPicture::setPicked(const std::optional<LabPlace>& place, const QString& label) {
    if (place == m_picked && label == m_pickedLabel)
        return;
    m_picked = place;
    m_pickedLabel = label;
    update();
}

void LabPicture::setLowest(const std::optional<glm::vec3>& direction) {
    if (direction == m_lowest)
        return;
    m_lowest = direction;
    update();
}

// --- Geometry ------------------------------------------------------------------------------------

int LabPicture::captionHeight() const {
    const int line = QFontMetrics(plotFont(font())).height();
    if (m_role == Role::Stage)
        return fontMetrics().height() + 4;
    // The sums of harmonics may have a third line: all have room for it, so that rows stay even.
    return (m_view.kind == LabKind::Harmonics ? 3 : 2) * line + 2;
}

QRectF LabPicture::box() const {
    const int pad = m_role == Role::Thumbnail ? kThumbnailPad : 0;
    const QRectF inside = QRectF(rect()).adjusted(pad, pad, -pad, -pad);
    if (m_role == Role::Stage)
        return inside.adjusted(0, captionHeight(), 0, 0);
    return inside.adjusted(0, 0, 0, -captionHeight());
}

QRectF LabPicture::pictureArea() const {
    QRectF area = box();
    double aspect = m_view.isTable() || m_view.isFace() ? 1.0 : m_view.isCross() ? 4.0 / 3.0 : 2.0;
    if (m_view.isTable() && m_role == Role::Stage) {
        // Left: the axis' name and numbers; right: the legend and its numbers; below: the axis.
        const QFontMetricsF metrics(plotFont(font()));
        const double numbers = metrics.horizontalAdvance(QStringLiteral("0.75")) + 6;
        area.adjust(metrics.height() + numbers, 4, -scaleWidth() - 12.0, -2 * metrics.height() - 2);
        aspect = std::clamp(area.width() / std::max(1.0, area.height()), 0.8, 1.6);
    }
    double width = std::min(area.width(), area.height() * aspect);
    double height = width / aspect;
    if (m_view.isCross()) { // faces of whole pixels
        const double ratio = devicePixelRatioF();
        const double face = std::max(1.0, std::floor(width * ratio / 4.0)) / ratio;
        width = 4.0 * face;
        height = 3.0 * face;
    }
    const double x = std::floor(area.center().x() - 0.5 * width);
    const double y = m_role == Role::Stage ? std::floor(area.top())
                                           : std::floor(area.center().y() - 0.5 * height);
    return {x, y, std::max(1.0, width), std::max(1.0, height)};
}

QSize LabPicture::pictureSize() const {
    const QSizeF size = pictureArea().size() * devicePixelRatioF();
    return {std::max(1, qRound(size.width())), std::max(1, qRound(size.height()))};
}

QPointF LabPicture::position(const LabPlace& place) const {
    const QRectF area = pictureArea();
    if (m_view.isTable())
        return {area.left() + static_cast<double>(place.NoV) * area.width(),
                area.bottom() - static_cast<double>(place.perceptualRoughness) * area.height()};
    const EnvironmentMapping mapping = mappingOf(m_view);
    const QRectF window = windowOf(m_view, mapping);
    const glm::vec2 p = mapping.position(place.direction);
    return {
        area.left() + (static_cast<double>(p.x) - window.left()) / window.width() * area.width(),
        area.top() + (static_cast<double>(p.y) - window.top()) / window.height() * area.height()};
}

std::optional<LabPlace> LabPicture::place(const QPointF& position) const {
    const QRectF area = pictureArea();
    if (!area.contains(position))
        return std::nullopt;
    const double x = (position.x() - area.left()) / area.width();
    const double y = (position.y() - area.top()) / area.height();
    LabPlace place;
    if (m_view.isTable()) {
        place.NoV = static_cast<float>(x);
        place.perceptualRoughness = static_cast<float>(1.0 - y);
        return place;
    }
    const EnvironmentMapping mapping = mappingOf(m_view);
    const QRectF window = windowOf(m_view, mapping);
    const auto ray = mapping.ray({static_cast<float>(window.left() + x * window.width()),
                                  static_cast<float>(window.top() + y * window.height())});
    if (!ray)
        return std::nullopt;
    place.direction = ray->direction;
    return place;
}

QPointF LabPicture::placeOf(const LabPlace& place) const {
    const QPointF exact = m_view.isTable()
                              ? QPointF(double{place.NoV}, double{place.perceptualRoughness})
                              : editor::placeOf(glm::dvec3(place.direction));
    return {m_axes[0].rounded(exact.x()), m_axes[1].rounded(exact.y())};
}

LabPlace LabPicture::labPlace(const QPointF& place) const {
    if (!m_view.isTable())
        return {directionAt(place), 0.0f, 0.0f};
    return {glm::vec3(0.0f), static_cast<float>(place.x()), static_cast<float>(place.y())};
}

QPointF LabPicture::pointOf(const QPointF& at) const {
    return position(labPlace(at));
}

std::optional<QPointF> LabPicture::placeAt(const QPointF& point) const {
    const std::optional<LabPlace> at = place(point);
    return at ? std::optional(placeOf(*at)) : std::nullopt;
}

std::vector<PlotValue> LabPicture::valuesAt(const QPointF& at) const {
    return m_reader ? m_reader(labPlace(at)) : std::vector<PlotValue>();
}

QString LabPicture::placeText(const QPointF& at) const {
    return m_view.isTable() ? PlotFrame::placeText(at) : directionText(at);
}

QColor LabPicture::colorAt(const LabPlace& place) const {
    if (m_picture.isNull())
        return tokens::kWell;
    const QRectF area = pictureArea();
    const QPointF at = position(place) - area.topLeft();
    const auto pixel = [](double share, int count) {
        return std::clamp(static_cast<int>(share * count), 0, count - 1);
    };
    return m_picture.pixelColor(pixel(at.x() / area.width(), m_picture.width()),
                                pixel(at.y() / area.height(), m_picture.height()));
}

QSize LabPicture::sizeHint() const {
    if (m_role == Role::Stage)
        return {320, 160 + captionHeight()};
    return {120, heightForWidth(120)};
}

int LabPicture::heightForWidth(int width) const {
    if (m_role == Role::Stage)
        return (m_view.isTable() ? width * 3 / 5 : width / 2) + captionHeight();
    const int inside = width - 2 * kThumbnailPad;
    return (m_view.isTable() ? inside * 4 / 5 : inside / 2) + captionHeight() + 2 * kThumbnailPad;
}

// --- Input ---------------------------------------------------------------------------------------

void LabPicture::resizeEvent(QResizeEvent*) {
    Q_EMIT resized();
}

void LabPicture::mousePressEvent(QMouseEvent* event) {
    if (m_role == Role::Stage)
        PlotFrame::mousePressEvent(event);
    else if (event->button() == Qt::LeftButton)
        Q_EMIT chosen();
}

// Of the stage: a face opens, or all are shown again.
bool LabPicture::pick(const QPointF& place, Qt::KeyboardModifiers) {
    if (m_view.isFace()) {
        Q_EMIT faceChosen(0);
        return true;
    }
    if (!m_view.isCross())
        return false;
    const QPointF at = (pointOf(place) - pictureArea().topLeft()) / pictureArea().width();
    for (int face = 1; face <= 6; ++face)
        if (static_cast<int>(std::floor(4 * at.x())) == labFace(face).column &&
            static_cast<int>(std::floor(4 * at.y())) == labFace(face).row)
            Q_EMIT faceChosen(face);
    return true;
}

void LabPicture::mouseMoveEvent(QMouseEvent* event) {
    if (!m_hovered && m_role == Role::Thumbnail) {
        m_hovered = true;
        update();
    }
    PlotFrame::mouseMoveEvent(event);
}

void LabPicture::leaveEvent(QEvent* event) {
    m_hovered = false;
    update();
    PlotFrame::leaveEvent(event);
}

void LabPicture::focusInEvent(QFocusEvent* event) {
    if (m_role == Role::Stage)
        PlotFrame::focusInEvent(event);
    update();
}

// A thumbnail is one of a sheet: the arrows go to its neighbours.
void LabPicture::keyPressEvent(QKeyEvent* event) {
    if (m_role == Role::Stage)
        return PlotFrame::keyPressEvent(event);
    switch (event->key()) {
    case Qt::Key_Left:
    case Qt::Key_Up:
        Q_EMIT stepped(-1);
        return;
    case Qt::Key_Right:
    case Qt::Key_Down:
        Q_EMIT stepped(1);
        return;
    case Qt::Key_Space:
    case Qt::Key_Return:
        Q_EMIT chosen();
        return;
    default:
        QWidget::keyPressEvent(event);
    }
}

// --- Painting ------------------------------------------------------------------------------------

void LabPicture::paintGround(QPainter& painter) const {
    if (m_role != Role::Thumbnail || !(m_selected || m_hovered))
        return;
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(m_selected ? tokens::kAccentDeep : tokens::kRaised));
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), tokens::kRadius,
                            tokens::kRadius);
}

void LabPicture::paintMessage(QPainter& painter, const QString& message) const {
    const QRectF shown = pictureArea();
    painter.fillRect(shown, QColor(tokens::kWell));
    painter.setFont(font());
    if (m_role == Role::Stage)
        paintPlotMessage(painter, shown, message);
    paintCaption(painter);
}

void LabPicture::paintValues(QPainter& painter) const {
    const QRectF shown = pictureArea();
    painter.save();
    if (!m_view.isCross()) {
        QPainterPath frame;
        frame.addRoundedRect(shown, 2, 2);
        painter.setClipPath(frame);
    }
    painter.drawImage(shown, m_picture);
    painter.restore();
    painter.setFont(font());
    if (m_view.isCross())
        paintCross(painter);
    else if (m_view.isTable())
        paintTable(painter);
    else if (!m_view.isFace())
        paintHorizon(painter);
    paintMarks(painter);
    paintCaption(painter);
    painter.setFont(plotFont(font()));
}

void LabPicture::paintProbe(QPainter& painter, const QPointF& place) const {
    const QPointF at = pointOf(place);
    if (pictureArea().adjusted(-1, -1, 1, 1).contains(at))
        PlotFrame::paintCross(painter, at, m_role == Role::Thumbnail ? 4.0 : 7.0);
}

void LabPicture::paintCaption(QPainter& painter) const {
    const QColor dim(m_selected && m_role == Role::Thumbnail ? tokens::kText : tokens::kTextDim);
    if (m_role == Role::Stage) {
        // On one line: the title, what matters of it, and the warning.
        QFont bold = font();
        bold.setWeight(QFont::DemiBold);
        painter.setFont(bold);
        painter.setPen(QColor(tokens::kText));
        const QFontMetrics titleMetrics(bold);
        const int height = titleMetrics.height();
        double x = 0;
        const QString title = titleMetrics.elidedText(m_caption, Qt::ElideRight, width());
        painter.drawText(QRectF(x, 0, width(), height), Qt::AlignLeft | Qt::AlignVCenter, title);
        x += titleMetrics.horizontalAdvance(title) + 10;
        painter.setFont(font());
        for (const auto& [text, color] :
             {std::pair(m_warning, QColor(tokens::kCopper)), std::pair(m_detail, dim)}) {
            if (text.isEmpty() || x > width() - 24)
                continue;
            const QString fitting =
                fontMetrics().elidedText(text, Qt::ElideRight, static_cast<int>(width() - x));
            painter.setPen(color);
            painter.drawText(QRectF(x, 0, width() - x, height), Qt::AlignLeft | Qt::AlignVCenter,
                             fitting);
            x += fontMetrics().horizontalAdvance(fitting) + 10;
        }
        return;
    }
    painter.setFont(plotFont(font()));
    const QFontMetrics metrics(painter.font());
    QRectF line(kThumbnailPad, height() - kThumbnailPad - captionHeight() + 2,
                width() - 2 * kThumbnailPad, metrics.height());
    for (const auto& [text, color] :
         {std::pair(m_caption, QColor(tokens::kText)), std::pair(m_detail, dim),
          std::pair(m_warning, QColor(tokens::kCopper))}) {
        painter.setPen(color);
        painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter,
                         metrics.elidedText(text, Qt::ElideRight, static_cast<int>(line.width())));
        line.translate(0, metrics.height());
    }
}

// Each face by its axis, in a corner where little is covered.
void LabPicture::paintCross(QPainter& painter) const {
    const QRectF area = pictureArea();
    const double face = area.width() / 4.0;
    for (int index = 1; index <= 6; ++index) {
        const LabFace& f = labFace(index);
        const QRectF cell(area.left() + f.column * face, area.top() + f.row * face, face, face);
        painter.setPen(QPen(QColor(tokens::kPanel), 1));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(cell);
        const QString name = QString::fromUtf8(f.name);
        if (m_role == Role::Stage || face >= 30)
            paintLabel(painter, name, cell.topLeft() + QPointF(2, 2));
    }
}

// The horizon, and on the stage the axes of the world.
void LabPicture::paintHorizon(QPainter& painter) const {
    const QRectF area = pictureArea();
    painter.setPen(QPen(QColor(255, 255, 255, 40), 1));
    const double y = std::round(area.center().y()) + 0.5;
    painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
    if (m_role == Role::Thumbnail)
        return;
    const QFontMetricsF metrics(plotFont(font()));
    const char* names[] = {"+Z", "−X", "−Z", "+X", "+Z"};
    for (int quarter = 0; quarter <= 4; ++quarter) {
        const QString name = QString::fromUtf8(names[quarter]);
        const double width = metrics.horizontalAdvance(name) + kLabelPad;
        const double x = area.left() + 0.25 * quarter * area.width() - 0.5 * width;
        paintLabel(painter, name,
                   {std::clamp(x, area.left() + 2, area.right() - width - 2),
                    area.bottom() - metrics.height() - 2});
    }
}

void LabPicture::paintTable(QPainter& painter) const {
    const QRectF area = pictureArea();
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(tokens::kLine), 1));
    painter.drawRect(area);
    if (m_role == Role::Thumbnail)
        return;
    painter.setFont(plotFont(font()));
    const QFontMetricsF metrics(painter.font());
    painter.setPen(QColor(tokens::kTextDim));
    const bool roomy = area.height() > 5 * metrics.height();
    for (int i = 0; i <= 4; ++i) {
        if (!roomy && i % 2 == 1)
            continue;
        const double share = i / 4.0;
        const QString text = QString::number(share, 'g', 3);
        const double x = area.left() + share * area.width();
        const double y = area.bottom() - share * area.height();
        painter.drawLine(QPointF(x, area.bottom()), QPointF(x, area.bottom() + 3));
        painter.drawLine(QPointF(area.left() - 3, y), QPointF(area.left(), y));
        painter.drawText(QRectF(x - 30, area.bottom() + 3, 60, metrics.height()), Qt::AlignHCenter,
                         text);
        painter.drawText(QRectF(area.left() - 66, y - 0.5 * metrics.height(), 60, metrics.height()),
                         Qt::AlignRight | Qt::AlignVCenter, text);
    }
    painter.drawText(
        QRectF(area.left(), area.bottom() + 2 + metrics.height(), area.width(), metrics.height()),
        Qt::AlignHCenter, m_axes[0].name);
    painter.save();
    painter.translate(area.left() - metrics.horizontalAdvance(QStringLiteral("0.75")) - 8,
                      area.center().y());
    painter.rotate(-90);
    painter.drawText(QRectF(-90, -metrics.height(), 180, metrics.height()), Qt::AlignHCenter,
                     m_axes[1].name);
    painter.restore();

    paintScale(painter, [](double share) {
        const glm::vec3 color = mapColor(ColorMap::Sequential, static_cast<float>(share));
        return QColor::fromRgbF(color.x, color.y, color.z);
    });
}

void LabPicture::paintMarks(QPainter& painter) const {
    const auto ring = [&](const QPointF& at, double radius, const QColor& color) {
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(QColor(0, 0, 0, 170), 3.5));
        painter.drawEllipse(at, radius, radius);
        painter.setPen(QPen(color, 1.6));
        painter.drawEllipse(at, radius, radius);
    };
    const bool small = m_role == Role::Thumbnail;
    const QRectF shown = pictureArea().adjusted(-1, -1, 1, 1);
    if (m_lowest && !small)
        paintLabel(painter, tr("magenta: below zero"), pictureArea().topLeft() + QPointF(4, 4));
    if (m_lowest)
        ring(position({*m_lowest, 0, 0}), small ? 3.0 : kMark, QColor(tokens::kCopper));
    if (!m_picked || !shown.contains(position(*m_picked)))
        return;
    const QPointF at = position(*m_picked);
    ring(at, small ? 3.5 : kMark + 1, QColor(tokens::kAccent));
    if (small || m_pickedLabel.isEmpty())
        return;
    painter.setFont(plotFont(font()));
    const QFontMetricsF metrics(painter.font());
    QRectF label(0, 0, metrics.horizontalAdvance(m_pickedLabel) + 10, metrics.height() + 4);
    const QRectF area = pictureArea();
    label.moveLeft(at.x() + 12 + label.width() < area.right()
                       ? at.x() + 12
                       : std::max(area.left() + 2, at.x() - 12 - label.width()));
    label.moveTop(std::clamp(at.y() - 0.5 * label.height(), area.top() + 2,
                             std::max(area.top() + 2, area.bottom() - label.height() - 2)));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(22, 24, 26, 215));
    painter.drawRoundedRect(label, 3, 3);
    painter.setPen(QColor(tokens::kText));
    painter.drawText(label, Qt::AlignCenter, m_pickedLabel);
}

} // namespace patina::editor
