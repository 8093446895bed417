#include "app/editor/wall/WallAxisControls.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/wall/WallState.h"
#include "app/editor/widget/NumberField.h"
#include "core/document/Snapshot.h"
#include "core/edit/Edit.h"
#include "core/library/Library.h"
#include "core/light/Environment.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>
#include <array>

namespace patina::editor {
namespace {

constexpr int kNumberWidth = 56;

// An ampersand in a name is no mnemonic.
QString menuText(QString name) {
    return name.replace(QLatin1Char('&'), QLatin1String("&&"));
}

QToolButton* makeMenuButton(QMenu* menu, const QString& name, const QString& tip) {
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("raised"));
    button->setPopupMode(QToolButton::InstantPopup);
    button->setMenu(menu);
    button->setAccessibleName(name);
    button->setToolTip(tip);
    button->setStatusTip(tip);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

NumberField* makeNumber(const NumberFormat& format, const QString& name, const QString& tip) {
    auto* field = new NumberField(format);
    field->setFixedWidth(kNumberWidth);
    field->setAccessibleName(name);
    field->setToolTip(tip);
    field->setStatusTip(tip);
    return field;
}

} // namespace

WallAxisControls::WallAxisControls(Axis axis, WallState& wall, DocumentController& controller,
                                   SelectionModel& selection, QWidget* parent)
    : QWidget(parent)
    , m_axis(axis)
    , m_wall(wall)
    , m_controller(controller)
    , m_selection(selection)
    , m_compared(new QComboBox)
    , m_choiceMenu(new QMenu(this))
    , m_parameterMenu(new QMenu(this)) {
    const bool columns = axis == Axis::Columns;
    const QString side = columns ? tr("Columns") : tr("Rows");
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(tokens::kGap / 2);
    row->addWidget(new QLabel(side));
    const std::array<std::pair<Compared, QString>, 6> kinds{{
        {Compared::Nothing, tr("Nothing")},
        {Compared::Environments, tr("Environments")},
        {Compared::Materials, tr("Materials")},
        {Compared::LightingModes, tr("Lighting Modes")},
        {Compared::ToneCurves, tr("Tone Curves")},
        {Compared::Values, tr("Values")},
    }};
    for (const auto& [compared, text] : kinds)
        m_compared->addItem(text, static_cast<int>(compared));
    const QString tip = columns ? tr("What the columns of the wall compare")
                                : tr("What the rows of the wall compare");
    m_compared->setAccessibleName(side);
    m_compared->setToolTip(tip);
    m_compared->setStatusTip(tip);
    connect(m_compared, &QComboBox::activated, this, [this](int index) {
        compare(static_cast<Compared>(m_compared->itemData(index).toInt()));
    });
    row->addWidget(m_compared);

    m_choices = makeMenuButton(m_choiceMenu, tr("Shown in %1").arg(side.toLower()),
                               tr("Choose which of them are shown"));
    connect(m_choiceMenu, &QMenu::aboutToShow, this, &WallAxisControls::fillChoices);
    m_choiceMenu->setToolTipsVisible(true);
    row->addWidget(m_choices);

    m_parameter = makeMenuButton(m_parameterMenu, tr("Parameter of %1").arg(side.toLower()),
                                 tr("Choose the parameter whose values are compared"));
    connect(m_parameterMenu, &QMenu::aboutToShow, this, &WallAxisControls::fillParameters);
    row->addWidget(m_parameter);
    m_from = makeNumber({}, tr("First value of %1").arg(side.toLower()), tr("The first value"));
    m_to = makeNumber({}, tr("Last value of %1").arg(side.toLower()), tr("The last value"));
    NumberFormat count;
    count.softMin = count.hardMin = 2;
    count.softMax = kMostOnWallSide;
    count.hardMax = static_cast<double>(kMostOnWallSide * kMostOnWallSide);
    count.decimals = 0;
    m_count = makeNumber(count, tr("Number of values of %1").arg(side.toLower()),
                         tr("How many values are compared, both ends included"));
    auto* to = new QLabel(tr("to"));
    auto* steps = new QLabel(tr("in"));
    for (QWidget* widget : {static_cast<QWidget*>(m_parameter), static_cast<QWidget*>(m_from),
                            static_cast<QWidget*>(to), static_cast<QWidget*>(m_to),
                            static_cast<QWidget*>(steps), static_cast<QWidget*>(m_count)}) {
        m_valueWidgets << widget;
        row->addWidget(widget);
    }
    for (NumberField* field : {m_from, m_to, m_count})
        for (const auto signal :
             {&NumberField::dragged, &NumberField::stepped, &NumberField::edited})
            connect(field, signal, this, [this, field](double value) {
                field->setValue(value);
                setValues();
            });
    refresh();
}

AxisPlan WallAxisControls::plan() const {
    return m_axis == Axis::Columns ? m_wall.plan().columns : m_wall.plan().rows;
}

void WallAxisControls::setPlan(const AxisPlan& plan) {
    WallPlan whole = m_wall.plan();
    (m_axis == Axis::Columns ? whole.columns : whole.rows) = plan;
    m_wall.setPlan(whole);
}

AxisPlan WallAxisControls::firstValues() const {
    return valuesPlan(*findParameter("material.perceptualRoughness"), {Scope::Material, 0});
}

void WallAxisControls::compare(Compared compared) {
    AxisPlan next;
    if (compared == Compared::Values)
        next = firstValues();
    next.compared = compared;
    setPlan(next);
}

void WallAxisControls::refresh() {
    const AxisPlan shown = plan();
    {
        const QSignalBlocker quiet(m_compared);
        // Offered where there are some.
        const int snapshots = m_compared->findData(static_cast<int>(Compared::Snapshots));
        const bool offered =
            !m_controller.document().snapshots.empty() || shown.compared == Compared::Snapshots;
        if (offered && snapshots < 0)
            m_compared->addItem(tr("Snapshots"), static_cast<int>(Compared::Snapshots));
        else if (!offered && snapshots >= 0)
            m_compared->removeItem(snapshots);
        m_compared->setCurrentIndex(m_compared->findData(static_cast<int>(shown.compared)));
    }
    const bool values = shown.compared == Compared::Values && shown.info != nullptr;
    for (QWidget* widget : m_valueWidgets)
        widget->setVisible(values);
    const std::vector<AxisChoice> choices =
        choicesOf(m_controller.document(), shown, mostOnAxis(m_wall.plan()));
    m_choices->setVisible(!choices.empty());
    const auto offered = std::ranges::count_if(
        choices, [](const AxisChoice& choice) { return choice.whyNot.empty(); });
    const auto taken = std::ranges::count_if(choices, &AxisChoice::shown);
    const bool alone = shown.compared == Compared::Environments && offered == 1;
    m_choices->setText(alone              ? tr("Add Environments")
                       : taken == offered ? tr("All %1").arg(taken)
                                          : tr("%1 of %2").arg(taken).arg(offered));
    if (!values)
        return;
    const Document& document = m_controller.document();
    const bool exists = shown.target.id == 0 || targetExists(document, shown.target);
    const QString name =
        exists && shown.target.id != 0 ? toQString(nameOf(document, shown.target)) : QString();
    m_parameter->setText(
        menuText(name.isEmpty() ? toQString(shown.info->label)
                                : tr("%1 of %2")
                                      .arg(toQString(shown.info->label),
                                           fontMetrics().elidedText(name, Qt::ElideMiddle, 160))));
    NumberFormat format;
    format.softMin = static_cast<double>(shown.info->softMin);
    format.softMax = static_cast<double>(shown.info->softMax);
    format.hardMin = static_cast<double>(shown.info->hardMin);
    format.hardMax = static_cast<double>(shown.info->hardMax);
    format.decimals = shown.info->decimals;
    m_from->setFormat(format);
    m_to->setFormat(format);
    m_from->setValue(static_cast<double>(shown.from));
    m_to->setValue(static_cast<double>(shown.to));
    m_count->setValue(shown.count);
}

void WallAxisControls::setValues() {
    AxisPlan next = plan();
    next.from = static_cast<float>(m_from->value());
    next.to = static_cast<float>(m_to->value());
    next.count = static_cast<int>(m_count->value());
    setPlan(next);
}

// --- Menus ---------------------------------------------------------------------------------------

void WallAxisControls::fillChoices() {
    m_choiceMenu->clear();
    const AxisPlan shown = plan();
    const std::size_t most = mostOnAxis(m_wall.plan());
    for (const AxisChoice& choice : choicesOf(m_controller.document(), shown, most))
        fillChoice(choice);
    m_choiceMenu->addSeparator();
    m_choiceMenu->addAction(tr("Show All"), this, [this] {
        AxisPlan all = plan();
        all.hidden.clear();
        setPlan(all);
    });
    if (shown.compared == Compared::Materials && m_controller.document().meshes.size() > 1)
        fillMeshes();
    if (shown.compared == Compared::Environments)
        fillBuiltin();
}

// Environments that ship with Patina: they join the scene and light nothing but cells.
void WallAxisControls::fillBuiltin() {
    QStringList missing;
    QMenu* menu = m_choiceMenu->addMenu(tr("Add Environment"));
    menu->setObjectName(QStringLiteral("addToWall"));
    for (const library::Entry& entry : library::environments()) {
        const QString source = QStringLiteral("builtin:") + toQString(entry.name);
        const bool known = std::ranges::any_of(
            m_controller.document().environments, [&](const Environment& environment) {
                return environment.kind == EnvironmentKind::Image &&
                       environment.source == source.toStdString();
            });
        if (known)
            continue;
        missing << source;
        menu->addAction(menuText(toQString(entry.title)), this, [this, source] {
            m_controller.addEnvironment(source, DocumentController::EnvironmentUse::Cells);
        });
    }
    menu->setEnabled(!missing.isEmpty());
    if (missing.size() < 2)
        return;
    menu->addSeparator();
    menu->addAction(tr("All of Them"), this, [this, missing] {
        for (const QString& source : missing)
            m_controller.addEnvironment(source, DocumentController::EnvironmentUse::Cells);
    });
}

void WallAxisControls::fillChoice(const AxisChoice& choice) {
    QAction* action = m_choiceMenu->addAction(menuText(toQString(choice.caption)));
    action->setCheckable(true);
    action->setChecked(choice.shown);
    action->setEnabled(choice.whyNot.empty());
    action->setToolTip(toQString(choice.whyNot));
    connect(action, &QAction::toggled, this, [this, id = choice.id](bool on) {
        AxisPlan next = plan();
        // What there was no room for is hidden, too, so that this one gets it.
        const std::size_t most = mostOnAxis(m_wall.plan());
        std::erase(next.hidden, id);
        if (!on) {
            next.hidden.push_back(id);
        } else {
            std::vector<AxisChoice> now = choicesOf(m_controller.document(), next, most);
            const auto shown = [&](Id wanted) {
                return std::ranges::any_of(now, [&](const AxisChoice& other) {
                    return other.id == wanted && other.shown;
                });
            };
            while (!shown(id)) {
                const auto last = std::find_if(now.rbegin(), now.rend(),
                                               [](const AxisChoice& other) { return other.shown; });
                next.hidden.push_back(last->id);
                now = choicesOf(m_controller.document(), next, most);
            }
        }
        setPlan(next);
    });
}

// Which meshes are given the materials.
void WallAxisControls::fillMeshes() {
    const AxisPlan shown = plan();
    QMenu* menu = m_choiceMenu->addMenu(tr("On"));
    const auto add = [&](const QString& name, std::vector<Id> meshes) {
        QAction* action = menu->addAction(menuText(name));
        action->setCheckable(true);
        action->setChecked(meshes == shown.meshes);
        connect(action, &QAction::triggered, this, [this, meshes = std::move(meshes)] {
            AxisPlan next = plan();
            next.meshes = meshes;
            setPlan(next);
        });
    };
    add(tr("All Visible Meshes"), {});
    const MeshInstance* mesh = m_controller.document().mesh(m_selection.mesh());
    if (mesh != nullptr)
        add(tr("Selected Mesh: %1").arg(toQString(mesh->name)), {mesh->id});
    for (const Id id : shown.meshes)
        if (const MeshInstance* given = m_controller.document().mesh(id);
            given != nullptr && given != mesh)
            add(toQString(given->name), {id});
}

void WallAxisControls::addParameters(QMenu& menu, const QString& title, Target target) {
    const Document& document = m_controller.document();
    QMenu* submenu = nullptr;
    for (const ParameterInfo& info : parameters()) {
        if (info.scope != target.scope || info.type != ParameterType::Float)
            continue;
        const bool applies =
            target.id == 0 || info.applies == nullptr || info.applies->holds(document, target.id);
        if (!applies)
            continue;
        if (submenu == nullptr)
            submenu = menu.addMenu(menuText(title));
        submenu->addAction(menuText(toQString(info.label)), this, [this, &info, target] {
            AxisPlan next = valuesPlan(info, target);
            next.count = plan().compared == Compared::Values ? plan().count : next.count;
            setPlan(next);
        });
    }
}

void WallAxisControls::fillParameters() {
    m_parameterMenu->clear();
    const Document& document = m_controller.document();
    addParameters(*m_parameterMenu, tr("All Materials"), {Scope::Material, 0});
    for (const Material& material : document.materials)
        addParameters(*m_parameterMenu, toQString(material.name), {Scope::Material, material.id});
    m_parameterMenu->addSeparator();
    addParameters(*m_parameterMenu, tr("Environment"), {Scope::Environment, 0});
    for (const Light& light : document.lights)
        addParameters(*m_parameterMenu, toQString(light.name), {Scope::Light, light.id});
    m_parameterMenu->addSeparator();
    addParameters(*m_parameterMenu, tr("Camera"), {Scope::View, 0});
    addParameters(*m_parameterMenu, tr("Shading"), {Scope::Model, 0});
}

} // namespace patina::editor
