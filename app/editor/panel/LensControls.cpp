#include "app/editor/panel/LensControls.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/FlowLayout.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Slider.h"

#include <QButtonGroup>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr double kMostIncident = 89.0; // light along the surface does not reach it

QToolButton* makeSegment(const QString& text, const QString& name, const QString& help) {
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("segment"));
    button->setText(QStringLiteral(" %1 ").arg(text));
    button->setToolTip(help);
    button->setStatusTip(help);
    button->setAccessibleName(name);
    button->setCheckable(true);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

} // namespace

LensControls::LensControls(QWidget* parent)
    : QWidget(parent)
    , m_flow(new FlowLayout(tokens::kGap, 4, this)) {
    m_flow->setContentsMargins(0, 0, 0, 0);
    m_flow->addWidget(makePages());
    m_flow->addWidget(makeIncidence());
    m_quantity = makeChoice(tr("Quantity"),
                            tr("What lobes show: the reflection fᵣ, or fᵣ times the cosine of the "
                               "viewer's angle, whose integral is the albedo"),
                            {QStringLiteral("fᵣ"), QStringLiteral("fᵣ · cos θₒ")});
    m_lobe = makeChoice(tr("Lobe"), tr("Which part of the reflection is shown"),
                        {tr("Both lobes"), tr("Specular"), tr("Diffuse")});
    m_channel = makeChoice(tr("Channel"), tr("Which number of a colour the curves show"),
                           {tr("Luminance"), tr("Red"), tr("Green"), tr("Blue")});
    m_logarithmic = makeSegment(tr("Log"), tr("Logarithmic"),
                                tr("Show lobes on a logarithmic scale, so that what is faint shows "
                                   "beside a strong highlight"));
    m_logarithmic->setChecked(true); // a highlight is often a thousand times what surrounds it
    connect(m_logarithmic, &QToolButton::toggled, this, &LensControls::changed);
    for (QWidget* widget : {static_cast<QWidget*>(m_quantity), static_cast<QWidget*>(m_lobe),
                            static_cast<QWidget*>(m_channel), static_cast<QWidget*>(m_logarithmic)})
        m_flow->addWidget(widget);
}

void LensControls::add(QWidget* widget) {
    m_flow->addWidget(widget);
}

QWidget* LensControls::makePages() {
    auto* pages = new QWidget;
    auto* row = new QHBoxLayout(pages);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(2);
    auto* group = new QButtonGroup(pages);
    const struct {
        QString text, help;
    } texts[] = {
        {tr("Lobe"), tr("Where light goes: polar and Cartesian plots, in space, on a ball")},
        {tr("D G F"), tr("The factors of the specular lobe")},
        {tr("Albedo"), tr("How much light comes back, by the viewer's angle")},
        {tr("All"), tr("Every plot")}};
    for (const auto& [text, help] : texts) {
        QToolButton* button = makeSegment(text, tr("Show %1").arg(text), help);
        group->addButton(button);
        row->addWidget(button);
        const auto page = static_cast<Page>(m_pages.size());
        connect(button, &QToolButton::clicked, this, [this, page] { setPage(page); });
        m_pages.push_back(button);
    }
    m_pages.front()->setChecked(true);
    return pages;
}

QWidget* LensControls::makeIncidence() {
    auto* box = new QWidget;
    auto* row = new QHBoxLayout(box);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(6);
    const QString help = tr("Angle of the light from the normal; also dragged in the polar plot");
    auto* label = new QLabel(tr("Light θᵢ"));
    label->setObjectName(QStringLiteral("dim"));
    m_slider = new Slider(0.0, kMostIncident, 0.0);
    m_slider->setFixedWidth(96);
    m_slider->setAccessibleName(tr("Angle of incidence slider"));
    m_angle =
        new NumberField({0.0, kMostIncident, 0.0, kMostIncident, 1, false, QStringLiteral("°")});
    m_angle->setAccessibleName(tr("Angle of incidence"));
    m_angle->setFixedWidth(56);
    for (QWidget* widget : {static_cast<QWidget*>(label), static_cast<QWidget*>(m_slider),
                            static_cast<QWidget*>(m_angle)}) {
        widget->setToolTip(help);
        widget->setStatusTip(help);
        row->addWidget(widget);
    }
    connect(m_slider, &Slider::dragged, this, &LensControls::setIncidence);
    for (auto signal : {&NumberField::dragged, &NumberField::stepped, &NumberField::edited})
        connect(m_angle, signal, this, &LensControls::setIncidence);
    m_slider->setValue(m_incidence);
    m_angle->setValue(m_incidence);
    return box;
}

QComboBox* LensControls::makeChoice(const QString& name, const QString& help,
                                    const QStringList& items) {
    auto* box = new QComboBox;
    box->setObjectName(QStringLiteral("small"));
    box->addItems(items);
    box->setAccessibleName(name);
    box->setToolTip(help);
    box->setStatusTip(help);
    box->setFocusPolicy(Qt::StrongFocus);
    connect(box, &QComboBox::currentIndexChanged, this, &LensControls::changed);
    return box;
}

void LensControls::setPage(Page page) {
    m_page = page;
    m_pages[static_cast<std::size_t>(page)]->setChecked(true);
    Q_EMIT pageChanged();
}

void LensControls::setIncidence(double degrees) {
    m_incidence = std::clamp(degrees, 0.0, kMostIncident);
    m_slider->setValue(m_incidence);
    m_angle->setValue(m_incidence);
    Q_EMIT changed();
}

LobeScale LensControls::scale() const {
    LobeScale scale;
    scale.lobe = static_cast<LensLobe>(m_lobe->currentIndex());
    scale.cosine = m_quantity->currentIndex() == 1;
    scale.logarithmic = m_logarithmic->isChecked();
    scale.channel = m_channel->currentIndex() - 1;
    return scale;
}

} // namespace patina::editor
