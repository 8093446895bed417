#include "app/editor/panel/ModelPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ColorConversion.h"
#include "app/editor/widget/FurnacePlot.h"
#include "app/editor/widget/PanelScroll.h"
#include "core/edit/EditSession.h"
#include "core/material/Material.h"
#include "core/material/ModelPresets.h"
#include "core/math/Shading.h"

#include <QGridLayout>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

QPushButton* makeButton(const QString& text, const QString& help) {
    auto* button = new QPushButton(text);
    button->setCheckable(true);
    button->setToolTip(help);
    button->setStatusTip(help);
    button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    return button;
}

// A disc in the metal's colour at normal incidence.
QIcon swatch(const Conductor& metal) {
    QPixmap pixmap(32, 32);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(toDisplay(shading::F_Conductor(1.0f, metal.n, metal.k)));
    painter.drawEllipse(QRectF(4, 4, 24, 24));
    return pixmap;
}

} // namespace

ModelPanel::ModelPanel(DocumentController& controller, SelectionModel& selection,
                       Thumbnails& thumbnails, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_furnace(new FurnacePlot)
    , m_parameters(new ParameterList(controller, thumbnails,
                                     {Scope::Model,
                                      [] {
                                          return std::optional(Target{Scope::Model, 0});
                                      },
                                      {}})) {
    auto* scroll = new PanelScroll;
    scroll->contents()->addWidget(makePresets());
    scroll->contents()->addWidget(m_furnace);
    scroll->contents()->addWidget(m_parameters);
    m_metalBox = makeMetals();
    m_parameters->addBelow("model.conductorK", m_metalBox);
    scroll->contents()->addStretch(1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);

    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (!change.target || change.target->scope == Scope::Model ||
            change.target->scope == Scope::Material)
            refresh();
    });
    connect(&selection, &SelectionModel::selectionChanged, this, &ModelPanel::refresh);
    refresh();
}

QWidget* ModelPanel::makePresets() {
    auto* box = new QWidget;
    auto* grid = new QGridLayout(box);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setSpacing(6);
    for (const ModelPreset& preset : modelPresets()) {
        QPushButton* button = makeButton(toQString(preset.title), toQString(preset.help));
        const int at = static_cast<int>(m_presets.size());
        grid->addWidget(button, at / 2, at % 2);
        m_presets.push_back(button);
        connect(button, &QPushButton::clicked, this, [this, &preset] {
            ShadingModel model = m_controller.document().model; // keeps its numbers
            model.distribution = preset.model.distribution;
            model.visibility = preset.model.visibility;
            model.fresnel = preset.model.fresnel;
            model.diffuse = preset.model.diffuse;
            model.multiScatter = preset.model.multiScatter;
            model.lobeDirection = preset.model.lobeDirection;
            apply(model, tr("Shade Like %1").arg(toQString(preset.title)));
        });
    }
    return box;
}

QWidget* ModelPanel::makeMetals() {
    auto* box = new QWidget;
    auto* grid = new QGridLayout(box);
    grid->setContentsMargins(0, 4, 0, 0);
    grid->setSpacing(6);
    for (const Conductor& metal : conductors()) {
        QPushButton* button =
            makeButton(toQString(metal.title),
                       tr("Give all metals the refractive index of %1 (%2)")
                           .arg(toQString(metal.title).toLower(), toQString(metal.source)));
        button->setIcon(swatch(metal));
        const int at = static_cast<int>(m_metals.size());
        grid->addWidget(button, at / 2, at % 2);
        m_metals.push_back(button);
        connect(button, &QPushButton::clicked, this, [this, &metal] {
            ShadingModel model = m_controller.document().model;
            model.conductorN = metal.n;
            model.conductorK = metal.k;
            apply(model, tr("Make Metals %1").arg(toQString(metal.title)));
        });
    }
    return box;
}

void ModelPanel::apply(const ShadingModel& model, const QString& undoText) {
    Document wanted;
    wanted.model = model;
    std::vector<ParameterEdit> edits;
    for (const ParameterInfo& info : parameters())
        if (info.scope == Scope::Model)
            edits.push_back({&info, info.get(wanted, 0)});
    m_controller.setParameters({Scope::Model, 0}, edits, undoText);
    refresh(); // a click on the preset in use must not switch it off
}

void ModelPanel::refresh() {
    const ShadingModel& model = m_controller.document().model;
    for (std::size_t i = 0; i < m_presets.size(); ++i)
        m_presets[i]->setChecked(sameChoices(modelPresets()[i].model, model));
    for (std::size_t i = 0; i < m_metals.size(); ++i)
        m_metals[i]->setChecked(conductors()[i].n == model.conductorN &&
                                conductors()[i].k == model.conductorK);
    m_metalBox->setVisible(model.fresnel == Fresnel::Conductor);
    m_furnace->setModel(model);
    if (const Material* material = m_controller.document().material(m_selection.material()))
        m_furnace->setRoughness(material->perceptualRoughness);
}

} // namespace patina::editor
