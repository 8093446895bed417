#include "app/editor/panel/MixerPanel.h"

#include "app/editor/document/FileKinds.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/panel/EnvironmentList.h"
#include "app/editor/panel/ParameterRow.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/LightIcon.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Slider.h"
#include "core/edit/EditSession.h"
#include "core/library/Library.h"
#include "core/light/Light.h"
#include "core/math/Shading.h"
#include "core/mix/LightMix.h"
#include "core/mix/MixLevels.h"

#include <QDateTime>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr Target kScene{Scope::Environment, 0}; // of the cross-fade

MixerChannel channelOf(const Environment& environment) {
    return {{Scope::Environment, environment.id},
            &parameter("environment.exposureEv"),
            &parameter("environment.tint"),
            &parameter("environment.enabled"),
            &parameter("environment.solo")};
}

} // namespace

MixerPanel::MixerPanel(DocumentController& controller, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_strips(new QHBoxLayout)
    , m_add(new QToolButton)
    , m_fade(new Slider(0.0, 1.0, 0.0))
    , m_fadeField(new NumberField({0.0, 1.0, 0.0, 1.0, 2, false, {}})) {
    m_fadeBox = makeFade();
    auto* desk = new QWidget;
    desk->setLayout(m_strips);
    m_strips->setContentsMargins(tokens::kGap, tokens::kGap, tokens::kGap, tokens::kGap);
    m_strips->setSpacing(6);
    m_strips->addWidget(m_fadeBox);
    m_strips->addStretch(1);
    auto* scroll = new QScrollArea;
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidget(desk);
    scroll->setFocusPolicy(Qt::NoFocus); // the channels have it
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);

    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument()) // another document
            abandonEdits(*this);
        if (isVisible())
            refresh();
    });
}

QSize MixerPanel::sizeHint() const {
    return {640, 300};
}

void MixerPanel::showEvent(QShowEvent*) {
    refresh();
}

// --- The cross-fade ------------------------------------------------------------------------------

QWidget* MixerPanel::makeFade() {
    auto* box = new QFrame;
    box->setObjectName(QStringLiteral("mixerStrip"));
    box->setFixedWidth(150);
    auto* layout = new QVBoxLayout(box);
    layout->setContentsMargins(8, 6, 8, 6);
    layout->setSpacing(6);
    auto* title = new QLabel(tr("Cross-Fade"));
    title->setAlignment(Qt::AlignCenter);
    layout->addWidget(title);
    layout->addWidget(makeSecondSource());
    layout->addStretch(1);
    layout->addWidget(m_fade);
    layout->addWidget(m_fadeField);
    layout->addStretch(1);

    const ParameterInfo& fade = parameter("environment.fade");
    describe(m_fade, toQString(fade.label), toQString(fade.help));
    describe(m_fadeField, toQString(fade.label),
             tr("%1\nDrag to change, Shift for fine and Ctrl for coarse steps; click to type.")
                 .arg(toQString(fade.help)));
    const auto begin = [this] { m_session = m_controller.newDragSession(); };
    const auto drag = [this, &fade](double value) {
        m_controller.setParameter(fade, kScene, static_cast<float>(value), m_session);
    };
    connect(m_fade, &Slider::dragStarted, this, begin);
    connect(m_fade, &Slider::dragged, this, drag);
    connect(m_fadeField, &NumberField::dragStarted, this, begin);
    connect(m_fadeField, &NumberField::dragged, this, drag);
    connect(m_fadeField, &NumberField::stepped, this, [this, &fade](double value) {
        const qint64 now = QDateTime::currentMSecsSinceEpoch();
        if (m_stepSession == 0 || now - m_lastStepMs > kStepPauseMs)
            m_stepSession = m_controller.newDragSession();
        m_lastStepMs = now;
        m_controller.setParameter(fade, kScene, static_cast<float>(value), m_stepSession);
    });
    connect(m_fadeField, &NumberField::edited, this, [this, &fade](double value) {
        m_controller.setParameter(fade, kScene, static_cast<float>(value));
        refresh();
    });
    return box;
}

QWidget* MixerPanel::makeSecondSource() {
    m_add->setObjectName(QStringLiteral("raised"));
    m_add->setPopupMode(QToolButton::InstantPopup);
    m_add->setFocusPolicy(Qt::StrongFocus);
    m_add->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    describe(m_add, tr("Second environment"), tr("Choose a second environment to cross-fade to"));
    auto* menu = new QMenu(m_add);
    m_add->setMenu(menu);
    connect(menu, &QMenu::aboutToShow, this, [this, menu] { fillSources(*menu); });
    return m_add;
}

void MixerPanel::fillSources(QMenu& menu) {
    menu.clear();
    const Document& document = m_controller.document();
    // The scene's other environments first, the one that is faded to ticked.
    for (const Environment& environment : document.environments) {
        if (environment.id == document.mix.first)
            continue;
        const Id id = environment.id;
        QAction* action = menu.addAction(EnvironmentList::titleOf(environment));
        action->setCheckable(true);
        action->setChecked(id == document.mix.second);
        action->setStatusTip(tr("Fade to this environment of the scene"));
        connect(action, &QAction::triggered, this, [this, id] { m_controller.fadeTo(id); });
    }
    if (document.environments.size() > 1)
        menu.addSeparator();
    QMenu* add = document.environments.size() > 1 ? menu.addMenu(tr("&Add Environment")) : &menu;
    for (const library::Entry& entry : library::environments()) {
        const QString source = QStringLiteral("builtin:") + QString::fromStdString(entry.name);
        QAction* action = add->addAction(QString::fromStdString(entry.title));
        action->setStatusTip(QString::fromStdString(entry.help));
        connect(action, &QAction::triggered, this, [this, source] { fadeToSource(source); });
    }
    add->addSeparator();
    connect(add->addAction(tr("Open &Image…")), &QAction::triggered, this, &MixerPanel::openSecond);
    if (document.mix.second != 0)
        connect(menu.addAction(tr("&None")), &QAction::triggered, this,
                [this] { m_controller.fadeTo(0); });
}

void MixerPanel::fadeToSource(const QString& source) {
    m_controller.addEnvironment(source, DocumentController::EnvironmentUse::FadeTo);
}

void MixerPanel::openSecond() {
    const QString key = QStringLiteral("folders/environments");
    const QString file = QFileDialog::getOpenFileName(
        this, tr("Second Environment"), proposedFolder(m_controller, key), environmentFilter());
    if (file.isEmpty())
        return;
    rememberFolder(m_controller, key, file);
    fadeToSource(file);
}

// --- The channels --------------------------------------------------------------------------------

std::vector<MixerChannel> MixerPanel::channels() const {
    const Document& document = m_controller.document();
    std::vector<MixerChannel> channels{channelOf(document.environment())};
    if (const Environment* second = document.secondEnvironment())
        channels.push_back(channelOf(*second));
    for (const Light& light : document.lights)
        channels.push_back({{Scope::Light, light.id},
                            &parameter("light.gainEv"),
                            &parameter("light.tint"),
                            &parameter("light.enabled"),
                            &parameter("light.solo")});
    return channels;
}

// Strips that stay are kept: they may have the keyboard.
void MixerPanel::rebuild() {
    const std::vector<MixerChannel> wanted = channels();
    std::vector<MixerStrip*> strips;
    for (const MixerChannel& channel : wanted) {
        const auto known =
            std::find_if(m_channels.begin(), m_channels.end(), [&](const MixerStrip* strip) {
                return strip && strip->channel() == channel;
            });
        if (known != m_channels.end()) {
            strips.push_back(*known);
            *known = nullptr;
        } else {
            strips.push_back(new MixerStrip(m_controller, channel));
        }
    }
    for (MixerStrip* gone : m_channels)
        if (gone)
            retire(gone);
    m_channels = strips;
    // The cross-fade stands between the environments.
    int at = 0;
    const auto place = [&](QWidget* widget) {
        if (m_strips->indexOf(widget) != at)
            m_strips->insertWidget(at, widget);
        ++at;
    };
    place(m_channels[0]);
    place(m_fadeBox);
    for (std::size_t i = 1; i < m_channels.size(); ++i)
        place(m_channels[i]);
    QWidget* before = m_channels[0];
    for (QWidget* next : {static_cast<QWidget*>(m_add), static_cast<QWidget*>(m_fadeField)}) {
        setTabOrder(before, next);
        before = next;
    }
}

void MixerPanel::refresh() {
    const Document& document = m_controller.document();
    const std::vector<MixerChannel> wanted = channels();
    if (!std::equal(wanted.begin(), wanted.end(), m_channels.begin(), m_channels.end(),
                    [](const MixerChannel& a, const MixerStrip* b) { return a == b->channel(); }))
        rebuild();
    for (MixerStrip* strip : m_channels)
        refreshStrip(*strip);
    const Environment* second = document.secondEnvironment();
    if (!second)
        for (QWidget* control : {static_cast<QWidget*>(m_fade), static_cast<QWidget*>(m_fadeField)})
            abandonEdits(*control);
    m_add->setText(second ? QFontMetrics(m_add->font())
                                .elidedText(EnvironmentList::titleOf(*second), Qt::ElideMiddle, 110)
                   : document.environments.size() > 1 ? tr("Choose Environment")
                                                      : tr("Add Environment"));
    m_fade->setEnabled(second != nullptr);
    m_fadeField->setEnabled(second != nullptr);
    m_fade->setValue(document.mix.fade);
    m_fadeField->setValue(document.mix.fade);
}

void MixerPanel::refreshStrip(MixerStrip& strip) {
    const Document& document = m_controller.document();
    if (strip.channel().target.scope == Scope::Light) {
        const Light& light = *document.light(strip.channel().target.id);
        strip.setName(QString::fromStdString(light.name), lightIcon(light.type));
        strip.refresh(lightLevel(document, light), isActive(document, light));
        return;
    }
    const Id id = strip.channel().target.id;
    strip.setName(EnvironmentList::titleOf(*document.environment(id)),
                  QStringLiteral("environment"));
    const auto role =
        id == document.mix.first ? EnvironmentPart::Role::First : EnvironmentPart::Role::Second;
    float lux = 0.0f;
    for (const EnvironmentPart& part : environmentParts(document))
        if (part.role == role)
            lux = illuminanceOf(part.image) * shading::luminance(part.scale);
    strip.refresh(lux, lux > 0.0f);
}

float MixerPanel::illuminanceOf(const ImagePtr& picture) {
    for (const Known& known : m_known)
        if (known.picture == picture)
            return known.illuminance;
    Known& known = m_known[m_nextKnown++ % m_known.size()];
    known = {picture, upwardIlluminance(*picture)};
    return known.illuminance;
}

} // namespace patina::editor
