#include "app/editor/widget/MapSlotWidget.h"

#include "app/editor/document/FileKinds.h"
#include "app/editor/document/QtText.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Thumbnails.h"
#include "core/library/Library.h"
#include "core/scene/ImageProblem.h"

#include <QComboBox>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMimeData>
#include <QPainter>
#include <QPainterPath>
#include <QToolButton>

namespace patina::editor {
namespace {

using namespace tokens;

QToolButton* smallButton(const QString& iconName, const QString& tip, const QString& accessible) {
    auto* button = new QToolButton;
    button->setIcon(icon(iconName));
    button->setIconSize({16, 16});
    button->setToolTip(tip);
    button->setStatusTip(tip);
    button->setAccessibleName(accessible);
    button->setFocusPolicy(Qt::TabFocus);
    button->setFixedSize(kRowHeight - 2, kRowHeight - 2);
    return button;
}

// One image is this map; several go by their names, which the window sees to.
QString droppedImage(const QMimeData* data) {
    if (data->urls().size() != 1)
        return {};
    const QString file = data->urls().front().toLocalFile();
    const FileKind kind = fileKind(file);
    return kind == FileKind::Image || kind == FileKind::Environment ? file : QString();
}

} // namespace

MapSlotWidget::MapSlotWidget(Thumbnails& thumbnails, const QString& name, bool wholeColor,
                             QWidget* parent)
    : QFrame(parent)
    , m_thumbnails(thumbnails)
    , m_name(name)
    , m_title(new ElidedLabel)
    , m_facts(new QLabel)
    , m_channel(new QComboBox)
    , m_browse(smallButton(QStringLiteral("open"), tr("Choose an image file"),
                           tr("Choose an image for %1").arg(name)))
    , m_tilingButton(smallButton(QStringLiteral("tiling"), tr("Scale, shift and turn the image"),
                                 tr("Tiling of %1").arg(name)))
    , m_clear(
          smallButton(QStringLiteral("close"), tr("Remove the image"), tr("Remove %1").arg(name))) {
    setAcceptDrops(true);
    setAccessibleName(name);
    m_facts->setObjectName(QStringLiteral("dim"));
    m_facts->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred); // the name is elided
    for (const QString& channel : {tr("RGB"), tr("Red"), tr("Green"), tr("Blue"), tr("Alpha")})
        m_channel->addItem(channel);
    m_channel->setObjectName(QStringLiteral("small"));
    m_channel->setToolTip(tr("Which channel of the image is read"));
    m_channel->setAccessibleName(tr("Channel of %1").arg(name));
    m_channel->setFocusPolicy(Qt::TabFocus);
    m_channel->setProperty("wholeColor", wholeColor);
    m_tilingButton->setCheckable(true);
    m_tiling = makeTiling();
    m_tiling->hide();

    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(kThumbnail + kGap, 0, 0, 0);
    grid->setHorizontalSpacing(3);
    grid->setVerticalSpacing(0);
    auto* heading = new QHBoxLayout;
    heading->setContentsMargins(0, 0, 0, 0);
    heading->setSpacing(kGap);
    heading->addWidget(m_title, 1);
    heading->addWidget(m_facts);
    grid->addLayout(heading, 0, 0, 1, 5);
    grid->addWidget(m_channel, 1, 0);
    grid->addWidget(m_tilingButton, 1, 2);
    grid->addWidget(m_browse, 1, 3);
    grid->addWidget(m_clear, 1, 4);
    grid->addWidget(m_tiling, 2, 0, 1, 5);
    grid->setColumnStretch(1, 1);
    grid->setRowMinimumHeight(0, kThumbnail / 2);
    grid->setRowMinimumHeight(1, kThumbnail / 2);

    connect(m_browse, &QToolButton::clicked, this, &MapSlotWidget::browseRequested);
    connect(m_clear, &QToolButton::clicked, this, &MapSlotWidget::clearRequested);
    connect(m_tilingButton, &QToolButton::toggled, m_tiling, &QWidget::setVisible);
    connect(m_channel, &QComboBox::activated, this,
            [this](int index) { Q_EMIT channelChosen(static_cast<MapChannel>(index)); });
    connect(&thumbnails, &Thumbnails::ready, this, &MapSlotWidget::refreshThumbnail);
    show({});
}

QWidget* MapSlotWidget::makeTiling() {
    auto* tiling = new QWidget;
    auto* grid = new QGridLayout(tiling);
    grid->setContentsMargins(0, 4, 0, 0);
    grid->setSpacing(4);
    m_tiling = tiling;
    const struct {
        QString label;
        glm::vec2 MapSlot::*vector;
    } rows[] = {{tr("Scale"), &MapSlot::uvScale}, {tr("Shift"), &MapSlot::uvOffset}};
    for (int row = 0; row < 2; ++row) {
        auto* label = new QLabel(rows[row].label);
        label->setObjectName(QStringLiteral("dim"));
        grid->addWidget(label, row, 0);
        for (int component = 0; component < 2; ++component)
            addTilingField(row, 1 + component,
                           rows[row].label +
                               (component == 0 ? QStringLiteral(" U") : QStringLiteral(" V")),
                           nullptr, rows[row].vector, component);
    }
    auto* label = new QLabel(tr("Turn"));
    label->setObjectName(QStringLiteral("dim"));
    grid->addWidget(label, 2, 0);
    addTilingField(2, 1, tr("Turn"), &MapSlot::uvRotationDeg, nullptr, 0);
    return tiling;
}

void MapSlotWidget::addTilingField(int row, int column, const QString& name, float MapSlot::*angle,
                                   glm::vec2 MapSlot::*vector, int component) {
    NumberFormat format{-2, 2, -1e4, 1e4, 3, false, {}};
    if (vector == &MapSlot::uvScale)
        format.softMin = 0, format.softMax = 8;
    if (angle)
        format = {-180, 180, -180, 180, 1, true, QStringLiteral("°")};
    auto* field = new NumberField(format);
    field->setAccessibleName(tr("%1: %2").arg(m_name, name));
    field->setToolTip(name);
    field->setMinimumWidth(44);
    static_cast<QGridLayout*>(m_tiling->layout())->addWidget(field, row, column);

    const auto number = [=](MapSlot& slot) -> float& {
        return angle ? slot.*angle : (slot.*vector)[component];
    };
    const auto with = [=, this](double value) {
        MapSlot slot = m_slot;
        number(slot) = static_cast<float>(value);
        return slot;
    };
    m_refreshTiling.push_back([=, this] { field->setValue(number(m_slot)); });
    connect(field, &NumberField::dragStarted, this, &MapSlotWidget::tilingDragStarted);
    connect(field, &NumberField::dragFinished, this, &MapSlotWidget::tilingDragFinished);
    connect(field, &NumberField::dragged, this,
            [=, this](double value) { Q_EMIT tilingDragged(with(value)); });
    connect(field, &NumberField::stepped, this,
            [=, this](double value) { Q_EMIT tilingEdited(with(value)); });
    connect(field, &NumberField::edited, this,
            [=, this](double value) { Q_EMIT tilingEdited(with(value)); });
}

void MapSlotWidget::setSlot(const MapSlot& slot) {
    if (slot == m_slot)
        return;
    show(slot);
}

void MapSlotWidget::show(const MapSlot& slot) {
    if (slot.source != m_slot.source)
        abandonEdits(*m_tiling); // was for the image before
    m_slot = slot;
    const bool assigned = slot.assigned();
    const bool broken = !slot.problem.empty();
    const QString source = QString::fromStdString(slot.source);
    m_title->setText(assigned ? sourceTitle(slot.source) : tr("No image"));
    QPalette colors = m_title->palette();
    colors.setColor(QPalette::WindowText, QColor(broken ? kCopper : assigned ? kText : kTextOff));
    m_title->setPalette(colors);
    const QString problem = QString::fromStdString(slot.problem);
    const ImagePtr& image = slot.image;
    const QString size = image ? tr("%1 × %2").arg(image->width()).arg(image->height()) : QString();
    setToolTip(broken     ? problem + QStringLiteral("\n") + source
               : image    ? source + QStringLiteral("\n") + size
               : assigned ? source
                          : tr("Drop an image here, or click to choose one"));
    setStatusTip(broken ? problem : assigned ? source : toolTip());
    const bool choosesChannel = assigned && !m_channel->property("wholeColor").toBool();
    const QString word = broken ? QString::fromStdString(problemWord(slot.problem)) : QString();
    // Most maps are square: the shorter form leaves their names more room.
    const bool square = image && image->width() == image->height();
    m_facts->setText(broken ? word : square ? QString::number(image->width()) + QChar(0xb2) : size);
    setAccessibleDescription(broken ? tr("%1: %2").arg(word, problem) : QString());
    m_channel->setVisible(choosesChannel);
    m_channel->setCurrentIndex(static_cast<int>(slot.channel));
    m_tilingButton->setVisible(assigned);
    m_clear->setVisible(assigned);
    if (!assigned)
        m_tilingButton->setChecked(false);
    for (const auto& refresh : m_refreshTiling)
        refresh();
    refreshThumbnail();
}

void MapSlotWidget::refreshThumbnail() {
    m_picture = m_thumbnails.thumbnail(m_slot.image, 2 * kThumbnail, m_slot.channel);
    update();
}

void MapSlotWidget::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    const QRectF tile(0.5, 0.5, kThumbnail - 1, kThumbnail - 1);
    QPainterPath shape;
    shape.addRoundedRect(tile, kRadius, kRadius);
    painter.fillPath(shape, QColor(kWell));
    if (!m_picture.isNull()) {
        painter.setClipPath(shape);
        // Fills the tile; the longer side is cut.
        const double scale = kThumbnail / double(std::min(m_picture.width(), m_picture.height()));
        const QSizeF size = QSizeF(m_picture.size()) * scale;
        painter.drawImage(QRectF(tile.center() - QPointF(size.width(), size.height()) / 2, size),
                          m_picture);
        painter.setClipping(false);
    } else {
        const bool broken = !m_slot.problem.empty();
        icon(broken ? QStringLiteral("warning") : QStringLiteral("add"),
             broken ? kCopper : kTextOff)
            .paint(&painter, QRect(14, 14, kThumbnail - 28, kThumbnail - 28));
    }
    painter.setPen(QPen(QColor(m_dropHover ? kAccent : kLine), m_dropHover ? 2 : 1));
    painter.drawPath(shape);
}

void MapSlotWidget::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton &&
        QRectF(0, 0, kThumbnail, kThumbnail).contains(event->position()))
        Q_EMIT browseRequested();
    else
        QFrame::mousePressEvent(event);
}

void MapSlotWidget::dragEnterEvent(QDragEnterEvent* event) {
    if (droppedImage(event->mimeData()).isEmpty())
        return;
    event->acceptProposedAction();
    m_dropHover = true;
    update();
}

void MapSlotWidget::dragLeaveEvent(QDragLeaveEvent*) {
    m_dropHover = false;
    update();
}

void MapSlotWidget::dropEvent(QDropEvent* event) {
    m_dropHover = false;
    update();
    const QString file = droppedImage(event->mimeData());
    if (file.isEmpty())
        return;
    event->acceptProposedAction();
    Q_EMIT fileDropped(file);
}

QString MapSlotWidget::sourceTitle(const std::string& source) {
    const QString text = QString::fromStdString(source);
    if (text.startsWith(QLatin1String("builtin:"))) {
        const QString name = text.mid(8).section(QLatin1Char('/'), 0, 0);
        for (const auto* entries : {&library::materials(), &library::environments()})
            for (const library::Entry& entry : *entries)
                if (name == QString::fromStdString(entry.name))
                    return QString::fromStdString(entry.title);
        return name;
    }
    const qsizetype embedded = text.lastIndexOf(QLatin1String("#embedded:"));
    if (embedded >= 0)
        return tr("image %1 of %2")
            .arg(text.mid(embedded + 10).toInt() + 1)
            .arg(shownFileName(text.left(embedded)));
    return shownFileName(text);
}

} // namespace patina::editor
