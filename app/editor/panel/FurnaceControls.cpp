#include "app/editor/panel/FurnaceControls.h"

#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/ViewState.h"
#include "app/editor/widget/ColorButton.h"
#include "app/editor/widget/NumberField.h"

#include <QHBoxLayout>
#include <QToolButton>
#include <algorithm>

namespace patina::editor {

FurnaceControls::FurnaceControls(ViewState& views, QWidget* parent)
    : QWidget(parent)
    , m_views(views)
    , m_colorButton(new ColorButton)
    , m_intensityField(new NumberField({0.1, 4.0, 0.01, 100.0, 2, false, {}})) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(tokens::kGap / 2);
    m_furnace = addButton(
        tr("Furnace"), tr("Look at the scene in a uniform environment without lights: a material "
                          "that loses and makes nothing cannot be seen in white ones"));
    m_furnaceView =
        addButton(tr("Furnace View"),
                  tr("Show in colours how much of the light each pixel returns; more than "
                     "all of it is marked"));
    connect(m_furnace, &QToolButton::clicked, this, &FurnaceControls::setFurnace);
    connect(m_furnaceView, &QToolButton::clicked, this,
            [this](bool on) { m_views.show(on ? shading::kViewFurnace : shading::kViewFinal); });
    m_colorButton->setAccessibleName(tr("Furnace colour"));
    m_colorButton->setFixedWidth(tokens::kFieldWidth - 2);
    m_colorButton->setToolTip(tr("Colour of the furnace"));
    m_intensityField->setAccessibleName(tr("Furnace intensity"));
    m_intensityField->setToolTip(tr("Radiance of the furnace (nit)"));
    m_intensityField->setFixedWidth(tokens::kFieldWidth - 20);
    row->addWidget(m_colorButton);
    row->addWidget(m_intensityField);
    for (auto signal : {&ColorButton::dragged, &ColorButton::edited})
        connect(m_colorButton, signal, this, &FurnaceControls::setColor);
    for (auto signal : {&NumberField::dragged, &NumberField::stepped, &NumberField::edited})
        connect(m_intensityField, signal, this, [this](double value) {
            m_intensity = value;
            apply();
        });
    connect(&views, &ViewState::changed, this, &FurnaceControls::refresh);
    refresh();
}

QToolButton* FurnaceControls::addButton(const QString& text, const QString& help) {
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("segment"));
    button->setText(text);
    button->setAccessibleName(text);
    button->setToolTip(help);
    button->setStatusTip(help);
    button->setCheckable(true);
    button->setFocusPolicy(Qt::TabFocus);
    layout()->addWidget(button);
    return button;
}

void FurnaceControls::setFurnace(bool on) {
    m_views.edit([&](render::ViewSettings& s) {
        s.furnace = on ? std::optional(m_color * static_cast<float>(m_intensity)) : std::nullopt;
    });
}

void FurnaceControls::setColor(const glm::vec3& color) {
    m_color = color;
    apply();
}

void FurnaceControls::apply() {
    if (m_views.settings().furnace)
        setFurnace(true);
    refresh();
}

void FurnaceControls::refresh() {
    const render::ViewSettings& s = m_views.settings();
    // Lit by somebody else, the furnace is shown as it is.
    const auto intensity = static_cast<float>(m_intensity);
    if (s.furnace && *s.furnace != m_color * intensity) {
        const float brightest = std::max({s.furnace->x, s.furnace->y, s.furnace->z, 1e-6f});
        m_intensity = static_cast<double>(brightest);
        m_color = *s.furnace / brightest;
    }
    m_furnace->setChecked(s.furnace.has_value());
    m_furnaceView->setChecked(m_views.shown() == shading::kViewFurnace);
    m_colorButton->setColor(m_color);
    m_intensityField->setValue(m_intensity);
}

} // namespace patina::editor
