#include "app/editor/ViewActions.h"

#include "app/editor/Actions.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/viewport/ViewState.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/mix/LightMix.h"

#include <QActionGroup>
#include <QCoreApplication>
#include <QKeyEvent>
#include <QMenu>
#include <algorithm>
#include <utility>

namespace patina::editor {

using render::ViewMode;
using render::ViewSettings;

namespace {

using namespace shading;

// An ampersand in a name is no mnemonic.
QString menuText(QString name) {
    return name.replace(QLatin1Char('&'), QLatin1String("&&"));
}

constexpr const char* kPeeks = "peeks"; // of an action

bool isModifier(int key) {
    return key == Qt::Key_Shift || key == Qt::Key_Control || key == Qt::Key_Alt ||
           key == Qt::Key_AltGr || key == Qt::Key_Meta;
}

} // namespace

QString ViewActions::keyOf(ViewKind kind) {
    return toQString(viewInfo(kind).key);
}

ViewActions::ViewActions(ViewState& views, DocumentController& controller, QObject* parent)
    : QObject(parent)
    , toFinal(make(tr("&Final or Last View"), QStringLiteral("0"),
                   tr("Show the picture; once more: what was looked at before"), true))
    , contribution(make(tr("&Contribution"), QStringLiteral("C"),
                        tr("Show what a factor does to the picture instead of its own value"),
                        false))
    , lockRange(make(tr("L&ock Range"), {},
                     tr("Keep the range of the colours while the picture changes"), false))
    , split(make(tr("&Split"), QStringLiteral("V"),
                 tr("Show another view on the other side of a line; Esc takes it away"), false))
    , strip(make(tr("&Thumbnails"), QStringLiteral("T"),
                 tr("Show or hide the strip of views under the viewport"), false))
    , equation(make(tr("&Equation"), QStringLiteral("="),
                    tr("Show or hide the picture as its sum, under the viewport"), false))
    , allTerms(make(tr("&All Terms"), QStringLiteral("Alt+0"),
                    tr("Make the picture of all its terms again"), true))
    , m_state(views)
    , m_controller(controller) {
    for (QAction* action : {contribution, lockRange, split, strip, equation})
        action->setCheckable(true);
    connect(toFinal, &QAction::triggered, &m_state, &ViewState::toggleFinal);
    connect(contribution, &QAction::triggered, this,
            [this](bool on) { m_state.setMode(on ? ViewMode::Contribution : ViewMode::Raw); });
    connect(lockRange, &QAction::triggered, this, [this](bool on) {
        const render::ViewChoice& shown = m_state.settings().shown;
        m_state.setRange(shown.kind, on ? std::optional(m_state.rangeOf(shown)) : std::nullopt);
    });
    connect(split, &QAction::triggered, &m_state, &ViewState::toggleSplit);
    connect(allTerms, &QAction::triggered, this,
            [this] { m_state.edit([](ViewSettings& settings) { settings.terms.fill(true); }); });
    QCoreApplication::instance()->installEventFilter(this); // sees keys before their actions do
    makeViews();
    makeCycles();
    makeTerms();
    connect(&m_state, &ViewState::changed, this, &ViewActions::refresh);
    // A light that is gone, or off, lights no factor.
    connect(&m_controller, &DocumentController::changed, this, [this] {
        const Id chosen = m_state.settings().light;
        const Light* light = m_controller.document().light(chosen);
        if (chosen != 0 && (light == nullptr || !isActive(m_controller.document(), *light)))
            m_state.edit([](ViewSettings& settings) { settings.light = 0; });
    });
    refresh();
}

QAction* ViewActions::make(const QString& label, const QString& keys, const QString& sentence,
                           bool peeks) {
    auto* action = new QAction(label, this);
    if (!keys.isEmpty())
        action->setShortcut(QKeySequence(keys));
    action->setAutoRepeat(false); // a held key peeks
    Actions::describe(action, sentence);
    action->setProperty(kPeeks, peeks);
    return action;
}

void ViewActions::makeViews() {
    auto* group = new QActionGroup(this);
    for (const ViewInfo& info : views()) {
        QAction* action =
            make(menuText(toQString(info.label)), keyOf(info.kind), toQString(info.help), true);
        action->setObjectName(QStringLiteral("view.") + toQString(info.id));
        action->setIconText(toQString(info.label));
        action->setCheckable(true);
        group->addAction(action);
        connect(action, &QAction::triggered, this,
                [this, kind = info.kind] { m_state.show(kind); });
        m_views.push_back(action);
    }
}

void ViewActions::makeCycles() {
    for (int i = 0; i < kViewGroupCount; ++i) {
        const auto group = static_cast<ViewGroup>(i);
        const QString name = toQString(viewGroupLabel(group));
        for (const bool back : {false, true}) {
            QAction* action =
                make(back ? tr("%1: View Before").arg(name) : tr("%1, in Turn").arg(name),
                     (back ? QStringLiteral("Shift+%1") : QStringLiteral("%1")).arg(i + 1),
                     back ? tr("Look at the view before, in this group")
                          : tr("Look at the next view of this group"),
                     true);
            connect(action, &QAction::triggered, this,
                    [this, group, back] { m_state.cycle(group, back); });
            m_cycles.push_back(action);
        }
    }
}

void ViewActions::makeTerms() {
    for (std::size_t i = 0; i < kTermCount; ++i) {
        const QString name = toQString(viewInfo(kTermViews[i]).label);
        QAction* action = make(name, QStringLiteral("Alt+%1").arg(i + 1),
                               tr("Take %1 out of the picture, or put it back").arg(name), true);
        action->setObjectName(QStringLiteral("term.%1").arg(i));
        action->setCheckable(true);
        connect(action, &QAction::triggered, this, [this, i](bool on) {
            m_state.edit([=](ViewSettings& settings) { settings.terms[i] = on; });
        });
        m_terms.push_back(action);
    }
}

QList<QAction*> ViewActions::listed() const {
    QList<QAction*> actions{toFinal, contribution, split, strip, equation, allTerms};
    for (QAction* action : m_terms)
        actions << action;
    for (std::size_t i = 0; i < m_cycles.size(); i += 2)
        actions << m_cycles[i];
    for (QAction* action : m_views)
        if (!action->shortcut().isEmpty())
            actions << action;
    return actions;
}

QList<QAction*> ViewActions::all() const {
    QList<QAction*> actions = listed();
    for (std::size_t i = 1; i < m_cycles.size(); i += 2)
        actions << m_cycles[i];
    return actions;
}

void ViewActions::refresh() {
    const ViewSettings& settings = m_state.settings();
    view(settings.shown.kind)->setChecked(true);
    contribution->setChecked(m_state.mode() == ViewMode::Contribution);
    for (std::size_t i = 0; i < kTermCount; ++i)
        m_terms[i]->setChecked(settings.terms[i]);
    split->setChecked(settings.split.has_value());
    lockRange->setChecked(settings.shown.range.has_value());
    lockRange->setEnabled(hasRange(settings.shown));
}

// --- Menu ------------------------------------------------------------------------------------

void ViewActions::fillMenu(QMenu& menu) {
    menu.setToolTipsVisible(true);
    menu.addAction(toFinal);
    menu.addSeparator();
    for (int i = 0; i < kViewGroupCount; ++i) {
        const auto group = static_cast<ViewGroup>(i);
        QMenu* submenu = menu.addMenu(menuText(toQString(viewGroupLabel(group))));
        submenu->setToolTipsVisible(true);
        for (const ViewInfo& info : views())
            if (info.group == group)
                submenu->addAction(view(info.kind));
        submenu->addSeparator();
        submenu->addAction(m_cycles[static_cast<std::size_t>(2 * i)]);
        submenu->addAction(m_cycles[static_cast<std::size_t>(2 * i + 1)]);
    }
    menu.addSeparator();
    menu.addActions({contribution, lockRange});
    QMenu* lights = menu.addMenu(tr("&Light of D, G, F"));
    lights->setToolTipsVisible(true);
    connect(lights, &QMenu::aboutToShow, this, [this, lights] { fillLights(*lights); });
    QMenu* steps = menu.addMenu(tr("&False Colour of Luminance"));
    steps->setToolTipsVisible(true);
    for (const float ev : {4.0f, 8.0f, 12.0f}) {
        QAction* action = steps->addAction(tr("±%1 EV").arg(ev), this, [this, ev] {
            m_state.setRange(kViewLuminance, render::ViewRange{-ev, ev});
            m_state.show(kViewLuminance);
        });
        Actions::describe(action, tr("Colours for this many steps around middle grey"));
    }
    menu.addSeparator();
    QMenu* terms = menu.addMenu(tr("Te&rms of the Picture"));
    terms->setToolTipsVisible(true);
    for (QAction* action : m_terms)
        terms->addAction(action);
    terms->addSeparator();
    terms->addAction(allTerms);
    menu.addSeparator();
    menu.addActions({split, strip, equation});
}

void ViewActions::fillLights(QMenu& menu) {
    menu.clear();
    auto* group = new QActionGroup(&menu);
    const auto add = [&](const QString& name, Id id, const QString& sentence) {
        QAction* action = menu.addAction(menuText(name));
        action->setCheckable(true);
        action->setChecked(m_state.settings().light == id);
        Actions::describe(action, sentence);
        group->addAction(action);
        connect(action, &QAction::triggered, this,
                [this, id] { m_state.edit([id](ViewSettings& s) { s.light = id; }); });
    };
    add(tr("Mirror Direction"), 0, tr("The factors for light from where a mirror would look"));
    for (const Light& light : m_controller.document().lights)
        if (isActive(m_controller.document(), light))
            add(toQString(light.name), light.id, tr("The factors of this light"));
}

// --- Keys that are held ------------------------------------------------------------------------

bool ViewActions::eventFilter(QObject* watched, QEvent* event) {
    switch (event->type()) {
    case QEvent::ShortcutOverride: // comes before the action's event, which has no time of its own
        if (const auto* key = static_cast<QKeyEvent*>(event); !key->isAutoRepeat())
            m_lastPressMs = key->timestamp();
        break;
    case QEvent::Shortcut: // to one of the actions; it is triggered next
        if (!watched->property(kPeeks).toBool())
            break;
        m_beforeHold = m_state.settings();
        m_held.start();
        m_heldSinceMs = std::exchange(m_lastPressMs, 0);
        break;
    case QEvent::KeyRelease: {
        const auto* key = static_cast<QKeyEvent*>(event);
        if (m_held.isValid() && !key->isAutoRepeat() && !isModifier(key->key()))
            endHold(heldUntil(key->timestamp()));
        break;
    }
    case QEvent::ApplicationDeactivate: // the release goes elsewhere
        if (m_held.isValid())
            endHold(m_held.elapsed() > kPeekMs);
        break;
    default:
        break;
    }
    return QObject::eventFilter(watched, event);
}

// By when the key moved, not by when the program got round to it: behind a slow frame a tap is
// still a tap. Events that other programs make may have no time.
bool ViewActions::heldUntil(quint64 releaseMs) const {
    if (m_heldSinceMs == 0 || releaseMs < m_heldSinceMs)
        return m_held.elapsed() > kPeekMs;
    return releaseMs - m_heldSinceMs > quint64{kPeekMs};
}

void ViewActions::endHold(bool restore) {
    m_held.invalidate();
    if (!restore)
        return;
    m_state.edit([this](ViewSettings& settings) {
        settings.shown = m_beforeHold.shown;
        settings.split = m_beforeHold.split;
        settings.terms = m_beforeHold.terms;
    });
}

} // namespace patina::editor
