#include "app/editor/panel/MixerStrip.h"

#include "app/editor/document/QtText.h"
#include "app/editor/panel/ParameterRow.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ColorButton.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/Fader.h"
#include "app/editor/widget/NumberField.h"

#include <QDateTime>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kWidth = 88;
constexpr double kMeterStops = 12.0; // the meter spans them, its middle is 1 lux
constexpr int kIconSize = 16;

// Three digits are what a light meter shows.
QString luxText(float lux) {
    if (!(lux > 0.0f))
        return QObject::tr("dark");
    return lux < 0.001f || lux >= 1e5f
               ? QStringLiteral("%1 lx").arg(double(lux), 0, 'g', 2)
               : QStringLiteral("%1 lx").arg(double(lux), 0, 'g', lux >= 1000.0f ? 5 : 3);
}

QToolButton* letter(const QString& text, const QString& objectName) {
    auto* button = new QToolButton;
    button->setText(text);
    button->setObjectName(objectName);
    button->setCheckable(true);
    button->setFocusPolicy(Qt::StrongFocus);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    return button;
}

} // namespace

MixerStrip::MixerStrip(DocumentController& controller, const MixerChannel& channel, QWidget* parent)
    : QFrame(parent)
    , m_controller(controller)
    , m_channel(channel)
    , m_layout(new QVBoxLayout(this))
    , m_icon(new QLabel)
    , m_name(new ElidedLabel)
    , m_fader(new Fader)
    , m_gain(new NumberField({channel.gain->softMin, channel.gain->softMax, channel.gain->hardMin,
                              channel.gain->hardMax, channel.gain->decimals, false,
                              QStringLiteral(" EV")}))
    , m_tint(new ColorButton)
    , m_mute(letter(QStringLiteral("M"), QStringLiteral("mute")))
    , m_solo(letter(QStringLiteral("S"), QStringLiteral("segment")))
    , m_level(new QLabel) {
    setObjectName(QStringLiteral("mixerStrip"));
    setFixedWidth(kWidth);
    m_layout->setContentsMargins(6, 6, 6, 6);
    m_layout->setSpacing(4);
    auto* head = new QHBoxLayout;
    head->setSpacing(4);
    head->addWidget(m_icon);
    head->addWidget(m_name, 1);
    m_layout->addLayout(head);
    m_layout->addWidget(m_fader, 1, Qt::AlignHCenter);
    m_level->setObjectName(QStringLiteral("dim"));
    m_level->setAlignment(Qt::AlignCenter);
    m_layout->addWidget(m_level);
    m_layout->addWidget(m_gain);
    m_layout->addWidget(m_tint);
    auto* switches = new QHBoxLayout;
    switches->setSpacing(4);
    switches->addWidget(m_mute);
    switches->addWidget(m_solo);
    m_layout->addLayout(switches);

    connectGain();
    connectTint();
    connect(m_mute, &QToolButton::clicked, this,
            [this](bool muted) { set(*m_channel.enabled, !muted); });
    connect(m_solo, &QToolButton::clicked, this, [this](bool solo) { set(*m_channel.solo, solo); });
}

void MixerStrip::setName(const QString& name, const QString& iconName) {
    m_name->setText(name);
    m_name->setToolTip(name);
    m_icon->setPixmap(icon(iconName).pixmap(QSize(kIconSize, kIconSize), devicePixelRatioF()));
    setAccessibleName(name);
    const QString gainHelp = toQString(m_channel.gain->help);
    describe(m_fader, tr("Gain of %1").arg(name),
             tr("%1\nDrag, or use the arrow keys; double-click or Home for 0 EV.").arg(gainHelp));
    describe(m_gain, tr("Gain of %1 in EV").arg(name), gainHelp);
    describe(m_tint, tr("Tint of %1").arg(name), toQString(m_channel.tint->help));
    describe(m_mute, tr("Mute %1").arg(name), tr("Mute: take %1 out of the mix").arg(name));
    describe(m_solo, tr("Solo %1").arg(name),
             tr("Solo: while anything is solo, everything else is off"));
    describe(m_level, tr("Level of %1").arg(name),
             m_channel.target.scope == Scope::Light
                 ? tr("Light at the scene's centre on a surface that faces %1").arg(name)
                 : tr("Light of %1 on a surface that faces up").arg(name));
}

void MixerStrip::refresh(float lux, bool active) {
    const Document& document = m_controller.document();
    const Id id = m_channel.target.id;
    const float ev = std::get<float>(m_channel.gain->get(document, id));
    m_fader->setEv(ev);
    m_fader->setLevel(lux > 0.0f ? 0.5 + std::log2(static_cast<double>(lux)) / kMeterStops : 0.0);
    m_gain->setValue(ev);
    m_tint->setColor(std::get<glm::vec3>(m_channel.tint->get(document, id)));
    m_mute->setChecked(!std::get<bool>(m_channel.enabled->get(document, id)));
    m_solo->setChecked(std::get<bool>(m_channel.solo->get(document, id)));
    m_level->setText(luxText(lux));
    m_name->setEnabled(active); // muted or silenced by another solo: dimmed
}

void MixerStrip::set(const ParameterInfo& info, const ParameterValue& value, DragSession session) {
    m_controller.setParameter(info, m_channel.target, value, session);
}

// Steps that follow each other quickly are one.
void MixerStrip::step(const ParameterInfo& info, const ParameterValue& value) {
    const qint64 now = QDateTime::currentMSecsSinceEpoch();
    if (m_stepSession == 0 || now - m_lastStepMs > kStepPauseMs)
        m_stepSession = m_controller.newDragSession();
    m_lastStepMs = now;
    set(info, value, m_stepSession);
}

void MixerStrip::connectGain() {
    const auto begin = [this] { m_session = m_controller.newDragSession(); };
    const auto drag = [this](double ev) {
        set(*m_channel.gain, static_cast<float>(ev), m_session);
    };
    const auto stepTo = [this](double ev) { step(*m_channel.gain, static_cast<float>(ev)); };
    const auto edit = [this](double ev) { set(*m_channel.gain, static_cast<float>(ev)); };
    connect(m_fader, &Fader::dragStarted, this, begin);
    connect(m_fader, &Fader::dragged, this, drag);
    connect(m_fader, &Fader::stepped, this, stepTo);
    connect(m_fader, &Fader::edited, this, edit);
    connect(m_gain, &NumberField::dragStarted, this, begin);
    connect(m_gain, &NumberField::dragged, this, drag);
    connect(m_gain, &NumberField::stepped, this, stepTo);
    connect(m_gain, &NumberField::edited, this, edit);
}

void MixerStrip::connectTint() {
    connect(m_tint, &ColorButton::dragStarted, this,
            [this] { m_session = m_controller.newDragSession(); });
    connect(m_tint, &ColorButton::dragged, this,
            [this](const glm::vec3& color) { set(*m_channel.tint, color, m_session); });
    connect(m_tint, &ColorButton::edited, this,
            [this](const glm::vec3& color) { set(*m_channel.tint, color); });
}

} // namespace patina::editor
