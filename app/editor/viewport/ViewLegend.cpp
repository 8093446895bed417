#include "app/editor/viewport/ViewLegend.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/ViewState.h"
#include "app/editor/widget/ColorScale.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/TextButton.h"
#include "core/light/Light.h"

#include <QApplication>
#include <QButtonGroup>
#include <QComboBox>
#include <QLabel>
#include <QPainter>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kLegendWidth = 236; // of the content
constexpr int kLegendSwatch = 12;
constexpr double kHuge = 1e9; // beyond any range that is typed

// Three digits that matter, and drags that are as fine as the number is small.
NumberFormat endFormat(const ViewInfo& info, const render::ViewRange& range, double end) {
    const double size = info.logarithmic ? end : static_cast<double>(range.max - range.min);
    NumberFormat format;
    format.decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 7);
    format.softMin = 0;
    format.softMax = 2 * size;
    format.hardMin = info.logarithmic ? 1 / kHuge : -kHuge;
    format.hardMax = kHuge;
    return format;
}

QLabel* wrapped(const QString& text) {
    auto* label = new QLabel(text);
    label->setWordWrap(true);
    label->setTextFormat(Qt::PlainText);
    label->setFixedWidth(kLegendWidth);
    return label;
}

} // namespace

ViewLegend::ViewLegend(ViewState& views, DocumentController& controller, ViewSide side,
                       QWidget* parent)
    : QFrame(parent)
    , m_views(views)
    , m_controller(controller)
    , m_side(side) {
    setObjectName(side == ViewSide::Shown ? QStringLiteral("legend")
                                          : QStringLiteral("legendOther"));
    setProperty("overlay", true);            // in the style sheet
    setAttribute(Qt::WA_NoMousePropagation); // a press here does not orbit
    setCursor(Qt::ArrowCursor);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSizeConstraint(QLayout::SetFixedSize);
    hide();
    connect(&m_views, &ViewState::changed, this, &ViewLegend::refresh);
    connect(&m_views, &ViewState::preparingChanged, this, &ViewLegend::refresh);
    connect(&m_views, &ViewState::rangeMeasured, this, &ViewLegend::refreshRange);
    connect(&m_controller, &DocumentController::changed, this, &ViewLegend::refresh);
    rebuild();
}

const render::ViewChoice* ViewLegend::choice() const {
    const render::ViewSettings& settings = m_views.settings();
    if (m_side == ViewSide::Shown)
        return &settings.shown;
    return settings.split ? &settings.split->other : nullptr;
}

bool ViewLegend::isWanted() const {
    const render::ViewChoice* shown = choice();
    return shown && (m_views.settings().split || shown->kind != shading::kViewFinal);
}

bool ViewLegend::isOnlyANote() const {
    return m_content.why.isEmpty() && !m_content.hasModes && !m_content.hasScale &&
           m_content.swatches.empty() && m_content.lights.empty();
}

void ViewLegend::refresh() {
    if (isWanted()) {
        LegendContent content =
            describeView(m_views.settings(), *choice(), m_controller.document());
        if (m_views.preparing() && content.why.isEmpty())
            content.note += (content.note.isEmpty() ? QString() : QStringLiteral(". ")) +
                            tr("One moment: the graphics driver prepares this view.");
        if (content != m_content) {
            m_content = content;
            rebuild();
        }
        refreshRange();
    }
    Q_EMIT changed();
}

// --- Content ---------------------------------------------------------------------------------

void ViewLegend::rebuild() {
    QString focused; // the control that takes the place of the one with the keyboard
    if (m_body) {
        if (const QWidget* focus = QApplication::focusWidget(); focus && isAncestorOf(focus))
            focused = focus->accessibleName();
        retire(m_body);
    }
    m_scale = nullptr;
    m_min = m_max = nullptr;
    m_automatic = nullptr;
    m_body = new QWidget;
    auto* rows = new QVBoxLayout(m_body);
    rows->setContentsMargins(10, 8, 10, 8);
    rows->setSpacing(6);
    addTitle(*rows);
    if (!m_content.why.isEmpty()) {
        auto* why = wrapped(m_content.why);
        why->setObjectName(QStringLiteral("legendWhy"));
        rows->addWidget(why);
        addRemedy(*rows);
    }
    if (m_content.hasModes)
        addModes(*rows);
    if (m_content.hasScale)
        addScale(*rows);
    if (!m_content.note.isEmpty()) {
        auto* note = wrapped(m_content.note);
        note->setObjectName(QStringLiteral("dim"));
        rows->addWidget(note);
    }
    addSwatches(*rows);
    if (!m_content.lights.empty())
        addLights(*rows);
    layout()->addWidget(m_body);
    m_body->show(); // now, so that the legend knows its size
    setToolTip(m_content.help);
    setAccessibleName(tr("Legend: %1").arg(m_content.title));
    setAccessibleDescription(m_content.why.isEmpty() ? m_content.help : m_content.why);
    refreshRange();
    for (QWidget* control : m_body->findChildren<QWidget*>())
        if (!focused.isEmpty() && control->accessibleName() == focused)
            control->setFocus(Qt::OtherFocusReason);
}

void ViewLegend::addRemedy(QVBoxLayout& rows) {
    QPushButton* button = nullptr;
    switch (m_content.remedy) {
    case ViewRemedy::None:
        return;
    case ViewRemedy::AddLight:
        button = makeTextButton(tr("Add a light"), tr("Adds a directional light to the scene"));
        break;
    case ViewRemedy::BakeTransfer:
        button = makeTextButton(tr("Bake transfer"),
                                tr("Bakes radiance transfer with the Bake dock's settings"));
        break;
    case ViewRemedy::BakeBounces:
        button = makeTextButton(tr("Bake with bounces"),
                                tr("Bakes interreflected transfer with the Bake dock's settings"));
        break;
    }
    button->setObjectName(QStringLiteral("legendRemedy"));
    connect(button, &QPushButton::clicked, this,
            [this, remedy = m_content.remedy] { Q_EMIT remedyWanted(remedy); });
    rows.addWidget(button, 0, Qt::AlignLeft);
}

void ViewLegend::addTitle(QVBoxLayout& rows) {
    auto* row = new QHBoxLayout;
    row->setSpacing(tokens::kGap);
    if (!m_content.why.isEmpty()) {
        auto* sign = new QLabel;
        sign->setPixmap(icon(QStringLiteral("warning"), tokens::kCopper)
                            .pixmap(QSize(16, 16), devicePixelRatioF()));
        row->addWidget(sign);
    }
    // "D: Distribution" and "N·L" say their symbol.
    if (!m_content.symbol.isEmpty() && !m_content.title.startsWith(m_content.symbol)) {
        auto* symbol = new QLabel(m_content.symbol);
        symbol->setObjectName(QStringLiteral("symbol"));
        row->addWidget(symbol);
    }
    auto* title = new QLabel(m_content.title);
    title->setObjectName(QStringLiteral("legendTitle"));
    row->addWidget(title);
    row->addStretch(1);
    if (!m_content.unit.isEmpty()) {
        auto* unit = new QLabel(m_content.unit);
        unit->setObjectName(QStringLiteral("dim"));
        row->addWidget(unit);
    }
    rows.addLayout(row);
}

void ViewLegend::addModes(QVBoxLayout& rows) {
    auto* row = new QHBoxLayout;
    row->setSpacing(2);
    auto* group = new QButtonGroup(m_body);
    const auto add = [&](const QString& label, const QString& help, render::ViewMode mode) {
        auto* button = new QToolButton;
        button->setObjectName(QStringLiteral("segment"));
        button->setText(label);
        button->setAccessibleName(label);
        button->setToolTip(help);
        button->setCheckable(true);
        button->setChecked(m_content.contribution == (mode == render::ViewMode::Contribution));
        button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        button->setFocusPolicy(Qt::TabFocus);
        group->addButton(button);
        row->addWidget(button);
        connect(button, &QToolButton::clicked, this, [this, mode] { m_views.setMode(mode); });
    };
    add(tr("Value"), tr("The factor's own value (C)"), render::ViewMode::Raw);
    add(tr("Contribution"), tr("What it does to the picture (C)"), render::ViewMode::Contribution);
    rows.addLayout(row);
}

void ViewLegend::addScale(QVBoxLayout& rows) {
    const ViewInfo& info = viewInfo(m_content.kind);
    m_scale = new ColorScale(info.colorMap, info.logarithmic);
    m_scale->setFixedWidth(kLegendWidth);
    m_scale->setAccessibleName(tr("Range of the colours"));
    m_scale->setToolTip(tr("Drag an end or the middle to lock the range; double-click: automatic"));
    connect(m_scale, &ColorScale::dragged, this, &ViewLegend::lockRange);
    const auto automatic = [this] { m_views.setRange(m_content.kind, std::nullopt); };
    connect(m_scale, &ColorScale::resetRequested, this, automatic);
    rows.addWidget(m_scale);

    auto* row = new QHBoxLayout;
    row->setSpacing(4);
    for (const bool isMax : {false, true}) {
        NumberField*& field = isMax ? m_max : m_min;
        field = new NumberField({});
        field->setFixedWidth(tokens::kFieldWidth);
        field->setAccessibleName(isMax ? tr("Largest value") : tr("Smallest value"));
        field->setToolTip(isMax ? tr("Where the colours end: drag or type to lock the range")
                                : tr("Where the colours begin: drag or type to lock the range"));
        for (auto signal : {&NumberField::dragged, &NumberField::stepped, &NumberField::edited})
            connect(field, signal, this, [this, isMax](double value) { typeEnd(value, isMax); });
    }
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("segment"));
    button->setText(tr("Auto"));
    button->setAccessibleName(tr("Automatic range"));
    button->setToolTip(info.automaticRange ? tr("Let the range follow the picture")
                                           : tr("The usual range of this view"));
    button->setCheckable(true);
    button->setFocusPolicy(Qt::TabFocus);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    connect(button, &QToolButton::clicked, this, [this](bool on) {
        const render::ViewChoice* shown = choice();
        if (shown)
            m_views.setRange(m_content.kind,
                             on ? std::nullopt : std::optional(m_views.rangeOf(*shown)));
    });
    m_automatic = button;
    row->addWidget(m_min);
    row->addWidget(button);
    row->addWidget(m_max);
    rows.addLayout(row);
}

void ViewLegend::addSwatches(QVBoxLayout& rows) {
    for (const LegendContent::Swatch& swatch : m_content.swatches) {
        QPixmap color(QSize(kLegendSwatch, kLegendSwatch) * devicePixelRatioF());
        color.setDevicePixelRatio(devicePixelRatioF());
        color.fill(swatch.color);
        auto* square = new QLabel;
        square->setPixmap(color);
        auto* name = new QLabel;
        name->setTextFormat(Qt::PlainText);
        name->setText(fontMetrics().elidedText(swatch.name, Qt::ElideMiddle,
                                               kLegendWidth - kLegendSwatch - tokens::kGap));
        auto* row = new QHBoxLayout;
        row->setSpacing(tokens::kGap);
        row->addWidget(square);
        row->addWidget(name, 1);
        rows.addLayout(row);
    }
    if (m_content.moreSwatches > 0)
        rows.addWidget(wrapped(tr("and %n more", nullptr, m_content.moreSwatches)));
}

void ViewLegend::addLights(QVBoxLayout& rows) {
    auto* row = new QHBoxLayout;
    row->setSpacing(tokens::kGap);
    auto* label = new QLabel(tr("Light"));
    auto* box = new QComboBox;
    box->setAccessibleName(tr("Light of the factors"));
    box->setToolTip(tr("Which direction of light the factor is computed for"));
    for (const LegendContent::LightChoice& light : m_content.lights) {
        box->addItem(light.name);
        if (light.id == m_content.light)
            box->setCurrentIndex(box->count() - 1);
    }
    connect(box, &QComboBox::activated, this, [this](int index) {
        const Id id = m_content.lights[static_cast<std::size_t>(index)].id;
        m_views.edit([id](render::ViewSettings& settings) { settings.light = id; });
    });
    row->addWidget(label);
    row->addWidget(box, 1);
    rows.addLayout(row);
}

// --- Range -----------------------------------------------------------------------------------

void ViewLegend::refreshRange() {
    const render::ViewChoice* shown = choice();
    if (!m_scale || !shown || shown->kind != m_content.kind)
        return;
    const render::ViewRange range = m_views.rangeOf(*shown);
    const ViewInfo& info = viewInfo(m_content.kind);
    if (!(range.max > range.min) || (info.logarithmic && range.min <= 0.0f))
        return;
    const auto min = static_cast<double>(range.min), max = static_cast<double>(range.max);
    m_scale->setRange(min, max);
    m_min->setFormat(endFormat(info, range, min));
    m_min->setValue(min);
    m_max->setFormat(endFormat(info, range, max));
    m_max->setValue(max);
    m_automatic->setChecked(!shown->range);
}

void ViewLegend::lockRange(double min, double max) {
    m_views.setRange(m_content.kind,
                     render::ViewRange{static_cast<float>(min), static_cast<float>(max)});
}

void ViewLegend::typeEnd(double value, bool isMax) {
    double min = isMax ? m_scale->min() : value;
    double max = isMax ? value : m_scale->max();
    if (!(max > min)) { // the other end gives way
        const bool logarithmic = viewInfo(m_content.kind).logarithmic;
        const double span = m_scale->max() - m_scale->min();
        (isMax ? min : max) =
            logarithmic ? (isMax ? value / 10 : value * 10) : (isMax ? value - span : value + span);
    }
    lockRange(min, max);
}

} // namespace patina::editor
