#include "app/editor/panel/LightsPanel.h"

#include "app/editor/document/Commands.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/PanelScroll.h"
#include "core/document/Lights.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QToolButton>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

// Rows of numbers that the light does not use are hidden.
bool applies(const ParameterInfo& info, const Document& document, Id id) {
    const Light& light = *document.light(id);
    const LightType type = light.type;
    if (info.id == "light.color")
        return !light.usesTemperature;
    if (info.id == "light.temperatureK")
        return light.usesTemperature;
    if (info.id == "light.position")
        return hasPosition(type);
    if (info.id == "light.azimuthDeg" || info.id == "light.elevationDeg")
        return hasDirection(type);
    if (info.id == "light.rollDeg" || info.id == "light.width" || info.id == "light.height")
        return type == LightType::Rectangle;
    if (info.id == "light.range")
        return hasRange(type);
    if (info.id == "light.innerConeDeg" || info.id == "light.outerConeDeg")
        return type == LightType::Spot;
    if (info.id == "light.radius")
        return type == LightType::Sphere;
    if (info.id == "light.castsShadow")
        return canCastShadow(type);
    if (info.id == "light.shadowSoftness")
        return canCastShadow(type) && light.castsShadow;
    return true;
}

QToolButton* textButton(const QString& iconName, const QString& text, const QString& tip) {
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("raised"));
    button->setIcon(icon(iconName));
    button->setText(text);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setToolTip(tip);
    button->setStatusTip(tip);
    button->setAccessibleName(tip);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

} // namespace

LightsPanel::LightsPanel(DocumentController& controller, SelectionModel& selection,
                         Thumbnails& thumbnails, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_list(new QListWidget)
    , m_empty(new QLabel(tr("Only the environment lights the scene.\nAdd a light above.")))
    , m_remove(new QToolButton)
    , m_parameters(new ParameterList(controller, thumbnails,
                                     {Scope::Light,
                                      [&selection]() -> std::optional<Target> {
                                          if (selection.light() == 0)
                                              return std::nullopt;
                                          return Target{Scope::Light, selection.light()};
                                      },
                                      {"light.enabled"}, // the list has it
                                      applies})) {
    auto* point = textButton(QStringLiteral("light-point"), tr("Point"), tr("Add a point light"));
    auto* sun =
        textButton(QStringLiteral("light-sun"), tr("Directional"), tr("Add a directional light"));
    m_remove->setIcon(icon(QStringLiteral("remove")));
    m_remove->setToolTip(tr("Remove the selected light"));
    m_remove->setStatusTip(m_remove->toolTip());
    m_remove->setAccessibleName(m_remove->toolTip());
    m_remove->setFocusPolicy(Qt::TabFocus);
    m_list->setAccessibleName(tr("Lights"));
    m_list->setStatusTip(tr("Tick to switch a light on, F2 to rename it"));
    m_list->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
    m_list->setIconSize({16, 16});
    m_list->setMaximumHeight(120);
    m_empty->setObjectName(QStringLiteral("dim"));
    m_empty->setAlignment(Qt::AlignCenter);

    auto* head = new QHBoxLayout;
    head->setSpacing(4);
    head->addWidget(point);
    head->addWidget(sun);
    head->addStretch(1);
    head->addWidget(m_remove);
    auto* scroll = new PanelScroll;
    scroll->contents()->addLayout(head);
    scroll->contents()->addWidget(m_list);
    scroll->contents()->addWidget(m_empty);
    scroll->contents()->addWidget(m_parameters);
    scroll->contents()->addStretch(1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);

    connect(point, &QToolButton::clicked, this,
            [this] { m_selection.selectLight(m_controller.addLight(LightType::Point)); });
    connect(sun, &QToolButton::clicked, this,
            [this] { m_selection.selectLight(m_controller.addLight(LightType::Directional)); });
    connect(m_remove, &QToolButton::clicked, this,
            [this] { m_controller.removeLight(m_selection.light()); });
    connect(m_list, &QListWidget::currentItemChanged, this, [this](QListWidgetItem* item) {
        if (!m_refreshing && item)
            m_selection.selectLight(item->data(Qt::UserRole).toUInt());
    });
    connect(m_list, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
        if (m_refreshing)
            return;
        const Target target{Scope::Light, item->data(Qt::UserRole).toUInt()};
        m_controller.setParameter(parameter("light.enabled"), target,
                                  item->checkState() == Qt::Checked);
        m_controller.rename(target, item->text());
    });
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (touches(change.affects, Affects::Structure))
            refreshList();
    });
    connect(&selection, &SelectionModel::selectionChanged, this, [this] {
        refreshList();
        m_parameters->refresh();
    });
    refreshList();
}

void LightsPanel::refreshList() {
    m_refreshing = true;
    const std::vector<Light>& lights = m_controller.document().lights;
    // Items are kept where they are: rebuilding the list would end an edit of a name.
    while (m_list->count() > static_cast<int>(lights.size()))
        delete m_list->takeItem(m_list->count() - 1);
    while (m_list->count() < static_cast<int>(lights.size()))
        m_list->addItem(new QListWidgetItem);
    for (int row = 0; row < m_list->count(); ++row) {
        const Light& light = lights[static_cast<std::size_t>(row)];
        QListWidgetItem* item = m_list->item(row);
        item->setText(QString::fromStdString(light.name));
        item->setIcon(icon(light.type == LightType::Point ? QStringLiteral("light-point")
                                                          : QStringLiteral("light-sun")));
        item->setFlags(item->flags() | Qt::ItemIsEditable | Qt::ItemIsUserCheckable);
        item->setCheckState(light.enabled ? Qt::Checked : Qt::Unchecked);
        item->setData(Qt::UserRole, light.id);
        if (light.id == m_selection.light())
            m_list->setCurrentRow(row);
    }
    const bool any = !lights.empty();
    m_list->setVisible(any);
    m_parameters->setVisible(any);
    m_empty->setVisible(!any);
    m_remove->setEnabled(m_selection.light() != 0);
    m_refreshing = false;
}

} // namespace patina::editor
