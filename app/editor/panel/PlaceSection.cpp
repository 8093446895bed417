#include "app/editor/panel/PlaceSection.h"

#include "app/editor/Actions.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/panel/ParameterList.h"
#include "core/document/SceneModels.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

QToolButton* buttonOf(QAction* action) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonIconOnly);
    button->setAccessibleName(action->iconText());
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

} // namespace

PlaceSection::PlaceSection(DocumentController& controller, SelectionModel& selection,
                           Thumbnails& thumbnails, const Actions& actions, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_parameters(new ParameterList(controller, thumbnails,
                                     {Scope::Mesh,
                                      [&selection]() -> std::optional<Target> {
                                          if (selection.mesh() == 0)
                                              return std::nullopt;
                                          return Target{Scope::Mesh, selection.mesh()};
                                      },
                                      {"mesh.visible"}})) // the list has it
    , m_wholeModel(new QCheckBox(tr("Whole model"))) {
    const QString help = tr("Handles and Drop to Ground take all meshes of the model together; "
                            "numbers are those of the selected mesh");
    m_wholeModel->setToolTip(help);
    m_wholeModel->setStatusTip(help);
    auto* tools = new QHBoxLayout;
    tools->setSpacing(4);
    for (QAction* action : {actions.placeHandles, actions.dropToGround, actions.backInPlace})
        tools->addWidget(buttonOf(action));
    tools->addStretch(1);
    tools->addWidget(m_wholeModel);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 4, 0, 0);
    layout->setSpacing(4);
    layout->addWidget(m_parameters);
    layout->addLayout(tools);

    connect(m_wholeModel, &QCheckBox::toggled, &selection, &SelectionModel::setWholeModel);
    connect(&selection, &SelectionModel::selectionChanged, this, &PlaceSection::refresh);
    refresh();
}

void PlaceSection::refresh() {
    setVisible(m_selection.mesh() != 0);
    m_parameters->refresh();
    m_wholeModel->setChecked(m_selection.wholeModel());
    m_wholeModel->setEnabled(meshesOfModel(m_controller.document(), m_selection.mesh()).size() > 1);
}

} // namespace patina::editor
