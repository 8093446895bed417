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

// The values apart, which are shown where they stand.
bool sameFields(const CellOwn& a, const CellOwn& b) {
    return std::ranges::equal(a.elements, b.elements,
                              [](Id x, Id y) { return (x != 0) == (y != 0); }) &&
           std::ranges::equal(a.values, b.values, [](const CellEdit& x, const CellEdit& y) {
               return x.target == y.target && x.info == y.info;
           });
}

QString elementHelp(CellElement element) {
    switch (element) {
    case CellElement::Environment:
        return OwnValueControls::tr("The environment that lights this cell");
    case CellElement::Material:
        return OwnValueControls::tr("The material of all visible meshes in this cell");
    case CellElement::Snapshot:
        return OwnValueControls::tr("The snapshot whose look this cell shows");
    }
    return {};
}

std::vector<Id> elementsOf(const Document& document, CellElement element) {
    std::vector<Id> ids;
    const auto add = [&ids](const auto& list) {
        for (const auto& one : list)
            ids.push_back(one.id);
    };
    switch (element) {
    case CellElement::Environment:
        add(document.environments);
        break;
    case CellElement::Material:
        add(document.materials);
        break;
    case CellElement::Snapshot:
        add(document.snapshots);
        break;
    }
    return ids;
}

// What a cell has of its own at first; 0: there is none to choose from.
Id firstElement(const Document& document, const Document& shown, const Cell& cell,
                CellElement element) {
    switch (element) {
    case CellElement::Environment:
        return shown.mix.first;
    case CellElement::Material:
        for (const MeshInstance& mesh : shown.meshes)
            if (mesh.visible)
                return mesh.material;
        return 0;
    case CellElement::Snapshot:
        return cell.snapshot != 0           ? cell.snapshot
               : document.snapshots.empty() ? Id{0}
                                            : document.snapshots.back().id;
    }
    return 0;
}

} // namespace

QString elementLabel(CellElement element) {
    switch (element) {
    case CellElement::Environment:
        return OwnValueControls::tr("Environment");
    case CellElement::Material:
        return OwnValueControls::tr("Material");
    case CellElement::Snapshot:
        return OwnValueControls::tr("Snapshot");
    }
    return {};
}

QString elementName(const Document& document, CellElement element, Id id) {
    if (element == CellElement::Environment) {
        const Environment* environment = document.environment(id);
        return environment != nullptr ? toQString(environmentTitle(*environment)) : QString();
    }
    if (element == CellElement::Material) {
        const Material* material = document.material(id);
        return material != nullptr ? toQString(material->name) : QString();
    }
    const Snapshot* snapshot = document.snapshot(id);
    return snapshot != nullptr ? toQString(snapshot->name) : QString();
}

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
        const bool any = std::ranges::any_of(m_elements, [](const QComboBox* box) { return box; });
        if (any && touches(change.affects, Affects::Structure))
            refresh(); // one may have come, or gone
    });
    refresh();
}

const CellOwn& OwnValueControls::currentOwn() const {
    static const CellOwn none;
    return m_wall.current() ? m_wall.cells()[*m_wall.current()].own : none;
}

void OwnValueControls::setElement(CellElement element, Id id) {
    m_wall.setOwnElement({m_wall.cells()[*m_wall.current()]}, element, id);
}

void OwnValueControls::refresh() {
    m_add->setEnabled(m_wall.current().has_value());
    const bool any = m_wall.isOn() && !currentOwn().isEmpty();
    setVisible(any);
    if (!any) {
        abandonEdits(*this);
        return;
    }
    const WallCell& cell = m_wall.cells()[*m_wall.current()];
    if (cell.shared != m_of || !sameFields(cell.own, m_made)) {
        makeFields();
        m_of = cell.shared;
    }
    m_made = cell.own;
    std::size_t field = 0;
    for (const CellElement element : kCellElements)
        if (QComboBox* box = m_elements[static_cast<std::size_t>(element)]) {
            fillElements(*box, element, cell.own.element(element));
            ++field;
        }
    for (const CellEdit& edit : cell.own.values) {
        QWidget* shownIn = m_fields[field++];
        if (auto* number = shownIn->findChild<NumberField*>())
            number->setValue(static_cast<double>(std::get<float>(edit.value)));
        if (auto* choice = shownIn->findChild<QComboBox*>()) {
            const QSignalBlocker quiet(choice);
            choice->setCurrentIndex(std::get<int>(edit.value));
        }
    }
}

void OwnValueControls::makeFields() {
    for (QWidget* field : m_fields) {
        m_row->removeWidget(field);
        retire(field);
    }
    m_fields.clear();
    m_elements = {};
    for (const CellElement element : kCellElements)
        if (currentOwn().element(element) != 0)
            addElementField(element);
    for (const CellEdit& edit : currentOwn().values)
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

void OwnValueControls::addElementField(CellElement element) {
    const QString label = elementLabel(element);
    QHBoxLayout* row = startField(label);
    auto* box = new QComboBox;
    box->setAccessibleName(label);
    box->setToolTip(elementHelp(element));
    box->setPlaceholderText(tr("Removed"));
    box->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    connect(box, &QComboBox::activated, this, [this, box, element](int index) {
        setElement(element, box->itemData(index).value<Id>());
    });
    row->addWidget(box);
    m_elements[static_cast<std::size_t>(element)] = box;
    endField(label, [this, element] { setElement(element, 0); });
}

void OwnValueControls::fillElements(QComboBox& box, CellElement element, Id shown) {
    const QSignalBlocker quiet(&box);
    const Document& document = m_controller.document();
    box.clear();
    for (const Id id : elementsOf(document, element))
        box.addItem(elementName(document, element, id), QVariant::fromValue(id));
    box.setCurrentIndex(box.findData(QVariant::fromValue(shown)));
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
        action->setChecked(std::ranges::any_of(currentOwn().values, isThis));
        const ParameterValue value = info.get(shown, target.id);
        connect(action, &QAction::toggled, this, [this, &info, target, value](bool own) {
            if (own)
                m_wall.setOwnValue({target, &info, value});
            else
                m_wall.linkValue(target, info);
        });
    }
}

// Elements of its own, which are those that it shows at first.
void OwnValueControls::addElements(const Document& cellDocument) {
    const Cell& cell = m_wall.cells()[*m_wall.current()].cell;
    for (const CellElement element : kCellElements) {
        const Id first = firstElement(m_controller.document(), cellDocument, cell, element);
        const bool own = currentOwn().element(element) != 0;
        if (first == 0 && !own)
            continue;
        QAction* action = m_menu->addAction(tr("Which %1").arg(elementLabel(element)));
        action->setCheckable(true);
        action->setChecked(own);
        connect(action, &QAction::toggled, this, [this, element, first](bool unlinked) {
            setElement(element, unlinked ? first : 0);
        });
    }
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
    addElements(*shown);
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
