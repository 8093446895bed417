#include "app/editor/panel/MaterialPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/PanelScroll.h"
#include "core/library/Library.h"
#include "core/material/Material.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>

namespace patina::editor {
MaterialPanel::MaterialPanel(DocumentController& controller, SelectionModel& selection,
                             Thumbnails& thumbnails, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_choice(new QComboBox)
    , m_library(new QToolButton)
    , m_parameters(new ParameterList(controller, thumbnails,
                                     {Scope::Material,
                                      [&selection]() -> std::optional<Target> {
                                          if (selection.material() == 0)
                                              return std::nullopt;
                                          return Target{Scope::Material, selection.material()};
                                      },
                                      {}})) {
    m_choice->setAccessibleName(tr("Material"));
    m_choice->setToolTip(tr("The material that is edited"));
    m_choice->setStatusTip(m_choice->toolTip());
    m_choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_library->setText(tr("Library"));
    m_library->setObjectName(QStringLiteral("raised"));
    m_library->setIcon(icon(QStringLiteral("library")));
    m_library->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    m_library->setPopupMode(QToolButton::InstantPopup);
    m_library->setToolTip(tr("Apply a library material"));
    m_library->setStatusTip(m_library->toolTip());
    m_library->setAccessibleName(tr("Material library"));
    m_library->setFocusPolicy(Qt::TabFocus);
    auto* menu = new QMenu(m_library);
    menu->setToolTipsVisible(true);
    for (const library::Entry& entry : library::materials()) {
        QAction* action =
            menu->addAction(QString::fromStdString(entry.title), this, [this, name = entry.name] {
                m_controller.applyLibraryMaterial(m_selection.material(),
                                                  QString::fromStdString(name));
            });
        action->setToolTip(QString::fromStdString(entry.help));
        action->setStatusTip(QString::fromStdString(entry.help));
    }
    m_library->setMenu(menu);

    auto* head = new QHBoxLayout;
    head->setContentsMargins(tokens::kMargin, tokens::kGap, tokens::kMargin, 0);
    head->setSpacing(tokens::kGap);
    head->addWidget(m_choice, 1);
    head->addWidget(m_library);
    auto* scroll = new PanelScroll;
    scroll->contents()->addWidget(m_parameters);
    scroll->contents()->addStretch(1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(head);
    layout->addWidget(scroll);

    connect(m_choice, &QComboBox::activated, this,
            [this](int index) { m_selection.selectMaterial(m_choice->itemData(index).toUInt()); });
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (touches(change.affects, Affects::Structure))
            refreshChoice();
    });
    connect(&selection, &SelectionModel::selectionChanged, this, [this] {
        refreshChoice();
        m_parameters->refresh();
    });
    refreshChoice();
}

void MaterialPanel::refreshChoice() {
    m_choice->clear();
    for (const Material& material : m_controller.document().materials)
        m_choice->addItem(QString::fromStdString(material.name), material.id);
    m_choice->setCurrentIndex(m_choice->findData(m_selection.material()));
    setEnabled(m_selection.material() != 0);
}

} // namespace patina::editor
