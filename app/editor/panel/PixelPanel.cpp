#include "app/editor/panel/PixelPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/panel/ExplanationModel.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/PixelPicker.h"
#include "app/editor/viewport/PixelProbe.h"
#include "app/editor/widget/ContributionChart.h"
#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/PanelScroll.h"
#include "app/editor/widget/StatusHint.h"

#include <QBoxLayout>
#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QStackedWidget>
#include <QToolButton>
#include <QTreeView>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kBeside = 620;     // wide enough for waterfall and tree side by side
constexpr int kOneRow = 440;     // wide enough for colour and buttons in one row
constexpr int kChartWidth = 330; // beside the tree
constexpr int kPixelSwatch = 34;
constexpr int kNameWidth = 130; // of the names in the tree at least: the numbers scroll before

QString sentence(PinState state) {
    switch (state) {
    case PinState::Seen:
        return PixelPanel::tr("Pinned");
    case PinState::Hidden:
        return PixelPanel::tr("Something hides the pinned point: numbers of when it was seen");
    case PinState::Outside:
        return PixelPanel::tr("The pinned point is not in the picture: numbers of when it was");
    }
    return {};
}

QToolButton* makeToolButton(const QString& iconName, const QString& name, const QString& help) {
    auto* button = new QToolButton;
    button->setIcon(icon(iconName));
    button->setIconSize({18, 18});
    button->setAccessibleName(name);
    button->setToolTip(help);
    button->setStatusTip(help);
    return button;
}

} // namespace

PixelPanel::PixelPanel(DocumentController& controller, PixelProbe& probe, PixelPicker& picker,
                       QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_probe(probe)
    , m_picker(picker)
    , m_model(new ExplanationModel(this)) {
    setObjectName(QStringLiteral("pixelPanel"));
    auto* empty = new QLabel(tr("Move the pointer over the picture to see what each pixel is made "
                                "of. P or Ctrl + Shift + click pins a point of the surface."));
    empty->setWordWrap(true);
    empty->setAlignment(Qt::AlignCenter);
    empty->setMargin(tokens::kMargin);
    empty->setObjectName(QStringLiteral("pixelEmpty"));

    m_chart = new ContributionChart;
    m_chartArea = new PanelScroll;
    m_chartArea->contents()->setContentsMargins(0, 0, 0, 0);
    m_chartArea->contents()->addWidget(m_chart);
    m_chartArea->contents()->addStretch(1);
    auto* shown = new QWidget;
    auto* layout = new QVBoxLayout(shown);
    layout->setContentsMargins(tokens::kGap, tokens::kGap, tokens::kGap, tokens::kGap);
    layout->setSpacing(tokens::kGap);
    layout->addWidget(makeHeader());
    m_body = new QBoxLayout(QBoxLayout::TopToBottom);
    m_body->setSpacing(tokens::kGap);
    m_body->addWidget(m_chartArea);
    m_body->addWidget(makeTree(), 1);
    layout->addLayout(m_body, 1);

    m_pages = new QStackedWidget;
    m_pages->addWidget(empty);
    m_pages->addWidget(shown);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->setSizeConstraint(QLayout::SetNoConstraint); // what is wide now can flow
    outer->addWidget(m_pages);

    connect(m_chart, &ContributionChart::chosen, this, &PixelPanel::reveal);
    connect(&m_probe, &PixelProbe::hoverChanged, this, &PixelPanel::refresh);
    connect(&m_probe, &PixelProbe::pinChanged, this, &PixelPanel::refresh);
    connect(&m_picker, &PixelPicker::pickingChanged, this, &PixelPanel::refreshHeader);
}

PixelPanel::~PixelPanel() {
    listen(false);
}

// --- Making --------------------------------------------------------------------------------------

QWidget* PixelPanel::makeHeader() {
    m_swatch = new QLabel;
    m_swatch->setFixedSize(kPixelSwatch, kPixelSwatch);
    m_swatch->setAccessibleName(tr("Displayed colour"));
    m_title = new ElidedLabel;
    m_title->setObjectName(QStringLiteral("pixelTitle"));
    m_title->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_subtitle = new ElidedLabel;
    m_subtitle->setObjectName(QStringLiteral("pixelSubtitle"));
    m_state = new QLabel;
    m_state->setObjectName(QStringLiteral("pixelState"));
    m_state->setWordWrap(true);

    m_pin = makeToolButton(QStringLiteral("pin"), tr("Pin"), {});
    m_pin->setCheckable(true);
    connect(m_pin, &QToolButton::clicked, this, [this] {
        if (m_probe.pin())
            m_probe.setPin(std::nullopt);
        else
            m_picker.setPicking(!m_picker.isPicking());
        refreshHeader();
    });
    m_copyText = makeToolButton(QStringLiteral("copy"), tr("Copy as Text"),
                                tr("Copy the whole explanation as text"));
    m_copyText->setText(tr("Text"));
    m_copyJson = makeToolButton(QStringLiteral("copy"), tr("Copy as JSON"),
                                tr("Copy the whole explanation as JSON, for scripts"));
    m_copyJson->setText(tr("JSON"));
    for (QToolButton* button : {m_copyText, m_copyJson})
        button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    connect(m_copyText, &QToolButton::clicked, this,
            [this] { copy(toText(*m_explanation), tr("Copied as text")); });
    connect(m_copyJson, &QToolButton::clicked, this,
            [this] { copy(toJson(*m_explanation), tr("Copied as JSON")); });
    m_channels = new QToolButton;
    m_channels->setText(tr("RGB"));
    m_channels->setCheckable(true);
    m_channels->setAccessibleName(tr("Channels"));
    m_channels->setToolTip(tr("Show red, green and blue of the contributions apart"));
    m_channels->setStatusTip(m_channels->toolTip());
    connect(m_channels, &QToolButton::toggled, m_chart, &ContributionChart::setChannels);

    auto* header = new QWidget;
    auto* words = new QVBoxLayout;
    words->setSpacing(0);
    words->addWidget(m_title);
    words->addWidget(m_subtitle);
    auto* facts = new QHBoxLayout;
    facts->setSpacing(tokens::kGap);
    facts->addWidget(m_swatch);
    facts->addLayout(words, 1);
    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(tokens::kGap);
    buttons->addWidget(m_channels);
    buttons->addStretch(1);
    buttons->addWidget(m_copyText);
    buttons->addWidget(m_copyJson);
    buttons->addWidget(m_pin);
    m_header = new QBoxLayout(QBoxLayout::LeftToRight);
    m_header->setSpacing(2);
    m_header->addLayout(facts, 1);
    m_header->addLayout(buttons);
    auto* rows = new QVBoxLayout(header);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(2);
    rows->addLayout(m_header);
    rows->addWidget(m_state);
    return header;
}

QWidget* PixelPanel::makeTree() {
    m_tree = new QTreeView;
    m_tree->setModel(m_model);
    m_tree->setHeaderHidden(true);
    m_tree->setUniformRowHeights(true);
    m_tree->setIndentation(14);
    m_tree->setIconSize({12, 12});
    m_tree->setAccessibleName(tr("Formulas and numbers"));
    m_tree->setSelectionMode(QAbstractItemView::SingleSelection);
    m_tree->setTextElideMode(Qt::ElideRight);
    m_tree->header()->setStretchLastSection(false);
    m_tree->header()->setMinimumSectionSize(kNameWidth);
    m_tree->header()->setSectionResizeMode(ExplanationModel::Name, QHeaderView::Stretch);
    m_tree->header()->setSectionResizeMode(ExplanationModel::Numbers, QHeaderView::Interactive);
    connect(m_model, &QAbstractItemModel::modelReset, this, &PixelPanel::openSections);
    return m_tree;
}

// Sections are open at first; formulas open by a click. Formulas and notes have the whole width.
void PixelPanel::openSections() {
    const auto span = [this](const auto& self, const QModelIndex& parent) -> void {
        for (int row = 0; row < m_model->rowCount(parent); ++row) {
            const QModelIndex child = m_model->index(row, 0, parent);
            const auto kind =
                static_cast<ExplanationModel::Kind>(child.data(ExplanationModel::KindRole).toInt());
            if (kind == ExplanationModel::Kind::Formula || kind == ExplanationModel::Kind::Note)
                m_tree->setFirstColumnSpanned(row, parent, true);
            if (kind == ExplanationModel::Kind::Section) {
                m_tree->setFirstColumnSpanned(row, parent, true);
                m_tree->expand(child);
            }
            self(self, child);
        }
    };
    span(span, {});
}

// --- Showing -------------------------------------------------------------------------------------

void PixelPanel::listen(bool wanted) {
    if (wanted == m_listens)
        return;
    m_listens = wanted;
    if (wanted)
        m_probe.addListener();
    else
        m_probe.removeListener();
}

void PixelPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    listen(true);
}

void PixelPanel::hideEvent(QHideEvent* event) {
    listen(false);
    QWidget::hideEvent(event);
}

QSize PixelPanel::minimumSizeHint() const {
    return {260, 150};
}

void PixelPanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    reflow();
}

void PixelPanel::reflow() {
    m_header->setDirection(width() >= kOneRow ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    const bool beside = width() >= kBeside;
    m_body->setDirection(beside ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    m_chartArea->setMinimumWidth(beside ? kChartWidth : 0);
    m_chartArea->setMaximumWidth(beside ? std::max(kChartWidth, width() * 2 / 5) : QWIDGETSIZE_MAX);
    const int wanted = m_chart->sizeHint().height() + 2;
    m_chartArea->setMinimumHeight(beside ? 0 : std::min(wanted, std::max(height() / 3, 110)));
    m_chartArea->setMaximumHeight(beside ? QWIDGETSIZE_MAX
                                         : std::min(wanted, std::max(height() / 3, 110)));
    // Three numbers, the colour before them, a unit behind.
    const QFontMetrics metrics(
        m_model->data(m_model->index(0, ExplanationModel::Numbers, {}), Qt::FontRole)
            .value<QFont>());
    m_tree->setColumnWidth(ExplanationModel::Numbers,
                           metrics.horizontalAdvance(QLatin1Char('0')) * (beside ? 36 : 29) + 22);
}

void PixelPanel::refresh() {
    if (!m_listens)
        return;
    m_explanation.reset();
    if (m_probe.shown())
        m_explanation = render::explain(*m_probe.shown(), m_controller.document());
    m_pages->setCurrentIndex(m_explanation ? 1 : 0);
    if (!m_explanation)
        return;
    m_model->setExplanation(*m_explanation);
    m_chart->setContributions(m_explanation->contributions);
    refreshHeader();
    reflow();
}

void PixelPanel::refreshHeader() {
    const bool pinned = m_probe.pin().has_value();
    m_pin->setChecked(pinned || m_picker.isPicking());
    const QString help =
        pinned ? tr("Take the pin away (P)")
               : tr("Pin a point of the surface: click it then (P, Ctrl + Shift + click, "
                    "Alt + click)");
    m_pin->setAccessibleName(pinned ? tr("Unpin") : tr("Pin"));
    m_pin->setToolTip(help);
    m_pin->setStatusTip(help);
    if (!m_explanation)
        return;
    const render::Explanation& e = *m_explanation;
    const auto byte = [](float x) { return qRound(255.0f * std::clamp(x, 0.0f, 1.0f)); };
    const QColor color(byte(e.displayed.x), byte(e.displayed.y), byte(e.displayed.z));
    QPixmap patch(m_swatch->size() * devicePixelRatioF());
    patch.setDevicePixelRatio(devicePixelRatioF());
    patch.fill(color);
    m_swatch->setPixmap(patch);
    m_swatch->setToolTip(tr("The displayed colour, %1").arg(color.name()));
    m_title->setText(QStringLiteral("%1   %2 %3 %4")
                         .arg(color.name())
                         .arg(color.red())
                         .arg(color.green())
                         .arg(color.blue()));
    m_subtitle->setText(
        e.mesh.empty() && e.material.empty()
            ? tr("Background · %1, %2").arg(e.x).arg(e.y)
            : tr("%1 · %2 · %3, %4")
                  .arg(QString::fromStdString(e.mesh), QString::fromStdString(e.material))
                  .arg(e.x)
                  .arg(e.y));
    QStringList notes;
    if (m_picker.isPicking())
        notes << tr("Click the point to pin; Esc leaves it");
    else if (pinned && m_probe.pinState() != PinState::Seen)
        notes << sentence(m_probe.pinState());
    if (!e.agrees())
        notes << tr("Red numbers are not what their formula gives on the CPU");
    m_state->setText(notes.join(QStringLiteral(". ")));
    m_state->setVisible(!notes.isEmpty());
}

void PixelPanel::reveal(const QString& contribution) {
    QString key = contribution;
    if (key == QLatin1String("diffuseIbl") || key == QLatin1String("specularIbl"))
        key = QStringLiteral("environment/") + key;
    else if (!key.startsWith(QLatin1String("light")) && key != QLatin1String("background"))
        key = QStringLiteral("sum/radiance");
    const QModelIndex index = m_model->find(key);
    if (!index.isValid())
        return;
    m_tree->expand(index);
    m_tree->setCurrentIndex(index);
    m_tree->scrollTo(index, QAbstractItemView::PositionAtTop);
}

void PixelPanel::copy(const std::string& text, const QString& what) {
    QGuiApplication::clipboard()->setText(QString::fromStdString(text));
    showHint(*this, what);
}

} // namespace patina::editor
