#include "app/editor/wall/OwnValueControls.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/wall/WallState.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/FlowLayout.h"
#include "app/editor/widget/ListButton.h"
#include "app/editor/widget/NumberField.h"
#include "core/document/Document.h"
#include "core/document/EnvironmentTitle.h"
#include "core/document/Snapshot.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>
#include <variant>

namespace patina::editor {
namespace {

constexpr int kOwnNumberWidth = 64;

bool canBeOwn(const ParameterInfo& info) {
    // Choices of other elements say what they are made of.
    const bool looks = info.scope == Scope::View || info.scope == Scope::Model;
    return info.type == ParameterType::Float || (info.type == ParameterType::Choice && looks);
}

QString literal(QString name) {
    return name.replace(QLatin1Char('&'), QLatin1String("&&"));
}

QString unitOf(const ParameterInfo& info) {
    const QString unit = toQString(info.unit);
    return unit.isEmpty() || unit == QStringLiteral("°") ? unit : QLatin1Char(' ') + unit;
}

// The values apart, whose number is shown where they stand.
bool sameFields(const std::vector<CellEdit>& a, const std::vector<CellEdit>& b) {
    return std::ranges::equal(a, b, [](const CellEdit& x, const CellEdit& y) {
        return x.target == y.target && x.info == y.info;
    });
}

} // namespace

QString ownValueText(const CellEdit& edit) {
    const ParameterInfo& info = *edit.info;
    const QString label = toQString(info.label);
    if (const int* choice = std::get_if<int>(&edit.value))
        return QStringLiteral("%1 %2").arg(
            label, toQString(info.choiceLabels[static_cast<std::size_t>(*choice)]));
    const QString number =
        NumberField::format(static_cast<double>(std::get<float>(edit.value)), info.decimals);
    return QStringLiteral("%1 %2%3").arg(label, number, unitOf(info));
}

OwnValueControls::OwnValueControls(WallState& wall, DocumentController& controller, QWidget* parent)
    : QWidget(parent)
    , m_wall(wall)
    , m_controller(controller)
    , m_row(new FlowLayout(tokens::kGap, tokens::kGap / 2, this))
    , m_menu(new QMenu(this))
    , m_add(new QToolButton) {
    setObjectName(QStringLiteral("ownValues"));
    m_row->setContentsMargins(0, 0, 0, 0);
    m_add->setObjectName(QStringLiteral("raised"));
    m_add->setText(tr("Unlink"));
    m_add->setPopupMode(QToolButton::InstantPopup);
    m_add->setMenu(m_menu);
    m_add->setFocusPolicy(Qt::TabFocus);
    m_add->setAccessibleName(tr("Unlink"));
    const QString tip = tr("Give the current cell a value of its own; all others stay linked to "
                           "the scene");
    m_add->setToolTip(tip);
    m_add->setStatusTip(tip);
    m_row->addWidget(new QLabel(tr("This cell")));
    connect(m_menu, &QMenu::aboutToShow, this, &OwnValueControls::fillMenu);
    connect(&wall, &WallState::changed, this, &OwnValueControls::refresh);
    connect(&wall, &WallState::cellsChosen, this, &OwnValueControls::refresh);
    connect(&wall, &WallState::ownChanged, this, &OwnValueControls::refresh);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (m_environment != nullptr && touches(change.affects, Affects::Structure))
            refresh(); // one may have come, or gone
    });
    refresh();
}

const std::vector<CellEdit>& OwnValueControls::shownValues() const {
    static const std::vector<CellEdit> none;
    return m_wall.current() ? m_wall.cells()[*m_wall.current()].own : none;
}

Id OwnValueControls::shownEnvironment() const {
    return m_wall.current() ? m_wall.cells()[*m_wall.current()].ownEnvironment : 0;
}

void OwnValueControls::refresh() {
    m_add->setEnabled(m_wall.current().has_value());
    const bool shown = m_wall.isOn() && (shownEnvironment() != 0 || !shownValues().empty());
    setVisible(shown);
    if (!shown) {
        abandonEdits(*this);
        return;
    }
    const WallCell& cell = m_wall.cells()[*m_wall.current()];
    if (cell.shared != m_of || (cell.ownEnvironment != 0) != (m_environment != nullptr) ||
        !sameFields(cell.own, m_values)) {
        makeFields();
        m_of = cell.shared;
    }
    if (m_environment != nullptr)
        fillEnvironments(cell.ownEnvironment);
    m_values = cell.own;
    const std::size_t first = m_environment != nullptr ? 1 : 0; // of the fields
    for (std::size_t i = 0; i < m_values.size(); ++i) {
        if (auto* number = m_fields[first + i]->findChild<NumberField*>())
            number->setValue(static_cast<double>(std::get<float>(cell.own[i].value)));
        if (auto* choice = m_fields[first + i]->findChild<QComboBox*>()) {
            const QSignalBlocker quiet(choice);
            choice->setCurrentIndex(std::get<int>(cell.own[i].value));
        }
    }
}

void OwnValueControls::makeFields() {
    for (QWidget* field : m_fields) {
        m_row->removeWidget(field);
        retire(field);
    }
    m_fields.clear();
    m_environment = nullptr;
    if (shownEnvironment() != 0)
        addEnvironmentField();
    for (const CellEdit& edit : shownValues())
        addField(edit);
}

QHBoxLayout* OwnValueControls::startField(const QString& label) {
    auto* field = new QWidget;
    auto* row = new QHBoxLayout(field);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(tokens::kGap / 2);
    row->addWidget(new QLabel(label));
    m_fields.push_back(field);
    return row;
}

template <class Link>
void OwnValueControls::endField(const QString& label, Link unlinked) {
    QToolButton* link = makeListButton(QStringLiteral("close"), {},
                                       tr("Link it again: this cell shows the scene's value"));
    link->setAccessibleName(tr("Link %1").arg(label));
    connect(link, &QToolButton::clicked, this, unlinked);
    QWidget* field = m_fields.back();
    field->layout()->addWidget(link);
    m_row->addWidget(field);
    field->show();
}

void OwnValueControls::addEnvironmentField() {
    const QString label = tr("Environment");
    QHBoxLayout* row = startField(label);
    m_environment = new QComboBox;
    m_environment->setAccessibleName(label);
    m_environment->setToolTip(tr("The environment that lights this cell"));
    m_environment->setPlaceholderText(tr("Removed"));
    m_environment->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    connect(m_environment, &QComboBox::activated, this, [this](int index) {
        m_wall.setOwnEnvironment({m_wall.cells()[*m_wall.current()]},
                                 m_environment->itemData(index).value<Id>());
    });
    row->addWidget(m_environment);
    endField(label, [this] { m_wall.setOwnEnvironment({m_wall.cells()[*m_wall.current()]}, 0); });
}

void OwnValueControls::fillEnvironments(Id shown) {
    const QSignalBlocker quiet(m_environment);
    m_environment->clear();
    for (const Environment& environment : m_controller.document().environments)
        m_environment->addItem(toQString(environmentTitle(environment)),
                               QVariant::fromValue(environment.id));
    m_environment->setCurrentIndex(m_environment->findData(QVariant::fromValue(shown)));
}

void OwnValueControls::addField(const CellEdit& edit) {
    const ParameterInfo& info = *edit.info;
    const QString label = toQString(info.label);
    QHBoxLayout* row = startField(label);
    const auto set = [this, target = edit.target, &info](const ParameterValue& value) {
        m_wall.setOwnValue({target, &info, value});
    };
    if (info.type == ParameterType::Choice) {
        auto* choice = new QComboBox;
        for (const std::string_view name : info.choiceLabels)
            choice->addItem(toQString(name));
        choice->setAccessibleName(label);
        choice->setToolTip(toQString(info.help));
        connect(choice, &QComboBox::activated, this, [set](int index) { set(index); });
        row->addWidget(choice);
    } else {
        NumberFormat format;
        format.softMin = static_cast<double>(info.softMin);
        format.softMax = static_cast<double>(info.softMax);
        format.hardMin = static_cast<double>(info.hardMin);
        format.hardMax = static_cast<double>(info.hardMax);
        format.decimals = info.decimals;
        format.wraps = info.wraps;
        format.unit = unitOf(info);
        auto* number = new NumberField(format);
        number->setFixedWidth(kOwnNumberWidth);
        number->setAccessibleName(label);
        number->setToolTip(toQString(info.help));
        for (const auto signal :
             {&NumberField::dragged, &NumberField::stepped, &NumberField::edited})
            connect(number, signal, this, [set](double value) { set(static_cast<float>(value)); });
        row->addWidget(number);
    }
    endField(label, [this, target = edit.target, &info] { m_wall.linkValue(target, info); });
}

// --- Which there are -----------------------------------------------------------------------------

void OwnValueControls::addParameters(QMenu& menu, const QString& title, const Target& target,
                                     const Document& shown) {
    QMenu* submenu = nullptr;
    for (const ParameterInfo& info : parameters()) {
        if (info.scope != target.scope || !canBeOwn(info) || info.ofScene ||
            (info.applies != nullptr && !info.applies->holds(shown, target.id)))
            continue;
        if (submenu == nullptr)
            submenu = menu.addMenu(literal(title));
        QAction* action = submenu->addAction(literal(toQString(info.label)));
        action->setCheckable(true);
        const auto isThis = [&](const CellEdit& edit) {
            return edit.target == target && edit.info == &info;
        };
        action->setChecked(std::ranges::any_of(shownValues(), isThis));
        const ParameterValue value = info.get(shown, target.id);
        connect(action, &QAction::toggled, this, [this, &info, target, value](bool own) {
            if (own)
                m_wall.setOwnValue({target, &info, value});
            else
                m_wall.linkValue(target, info);
        });
    }
}

// One of its own, which is the one that it shows at first.
void OwnValueControls::addEnvironment(Id shown) {
    QAction* action = m_menu->addAction(tr("Which Environment"));
    action->setCheckable(true);
    action->setChecked(shownEnvironment() != 0);
    connect(action, &QAction::toggled, this, [this, shown](bool own) {
        m_wall.setOwnEnvironment({m_wall.cells()[*m_wall.current()]}, own ? shown : 0);
    });
}

void OwnValueControls::fillMenu() {
    m_menu->clear();
    if (!m_wall.current())
        return;
    const Result<Document> shown =
        documentOf(m_controller.document(), m_wall.cells()[*m_wall.current()].cell);
    if (!shown) {
        m_menu->addAction(toQString(shown.error().message))->setEnabled(false);
        return;
    }
    addEnvironment(shown->mix.first);
    addParameters(*m_menu, tr("Environment"), {Scope::Environment, 0}, *shown);
    addParameters(*m_menu, tr("Camera"), {Scope::View, 0}, *shown);
    addParameters(*m_menu, tr("Shading"), {Scope::Model, 0}, *shown);
    m_menu->addSeparator();
    std::vector<Id> used; // of what the cell shows
    for (const MeshInstance& mesh : shown->meshes)
        if (mesh.visible && std::ranges::find(used, mesh.material) == used.end())
            used.push_back(mesh.material);
    for (const Material& material : shown->materials)
        if (std::ranges::find(used, material.id) != used.end())
            addParameters(*m_menu, toQString(material.name), {Scope::Material, material.id},
                          *shown);
    for (const Light& light : shown->lights)
        addParameters(*m_menu, toQString(light.name), {Scope::Light, light.id}, *shown);
}

} // namespace patina::editor
