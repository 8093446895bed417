#include "app/editor/viewport/TermTile.h"

#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/ViewThumb.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

namespace patina::editor {

TermTile::TermTile(ViewKind kind, const QString& caption, Abilities abilities, QWidget* parent)
    : QWidget(parent)
    , m_thumb(new ViewThumb(kind))
    , m_name(new QLabel(caption)) {
    const std::string_view id = viewInfo(kind).id;
    setObjectName(QStringLiteral("tile.") +
                  QString::fromUtf8(id.data(), static_cast<qsizetype>(id.size())));
    const QString term = m_thumb->accessibleName();
    m_thumb->setObjectName(QStringLiteral("term"));
    m_thumb->makeSmall();
    m_name->setObjectName(QStringLiteral("termName"));
    m_name->setAlignment(Qt::AlignCenter);

    auto* buttons = new QVBoxLayout;
    buttons->setContentsMargins(0, 0, 0, 0);
    buttons->setSpacing(1);
    if (abilities.switches) {
        m_on = makeButton(QStringLiteral("on"), tr("%1: part of the picture").arg(term),
                          tr("Take %1 out of the picture, or put it back").arg(term));
        m_solo = makeButton(QStringLiteral("solo"), tr("%1: alone").arg(term),
                            tr("Show %1 alone; once more: the terms before").arg(term));
        m_solo->setText(QStringLiteral("S"));
        for (QToolButton* button : {m_on, m_solo}) {
            button->setCheckable(true);
            buttons->addWidget(button);
        }
        connect(m_on, &QToolButton::clicked, this, &TermTile::switched);
        connect(m_solo, &QToolButton::clicked, this, &TermTile::soloClicked);
        setOn(true, false);
    }
    if (abilities.opens) {
        m_open = makeButton(QStringLiteral("open"), tr("%1: factors").arg(term),
                            tr("Open %1: what it is made of (double-click)").arg(term));
        m_open->setIcon(icon(QStringLiteral("chevron-right")));
        connect(m_open, &QToolButton::clicked, this, &TermTile::opened);
        connect(m_thumb, &ViewThumb::doubleClicked, this, [this] {
            if (m_open->isEnabled())
                Q_EMIT opened();
        });
        buttons->addWidget(m_open);
    }
    buttons->addStretch(1);
    auto* top = new QHBoxLayout;
    top->setSpacing(1);
    top->addWidget(m_thumb);
    top->addLayout(buttons);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(top);
    layout->addWidget(m_name);
}

QToolButton* TermTile::makeButton(const QString& id, const QString& name, const QString& sentence) {
    auto* button = new QToolButton;
    button->setObjectName(id);
    button->setFixedSize(20, 20);
    button->setIconSize({14, 14});
    button->setFocusPolicy(Qt::TabFocus);
    button->setAccessibleName(name);
    button->setToolTip(sentence);
    button->setStatusTip(sentence);
    return button;
}

void TermTile::setOn(bool on, bool alone) {
    m_on->setChecked(on); // a click has checked it already
    m_solo->setChecked(alone);
    if (on == m_isOn)
        return;
    m_isOn = on;
    m_on->setIcon(on ? icon(QStringLiteral("eye"), tokens::kTextDim)
                     : icon(QStringLiteral("eye-off"), tokens::kCopper));
    m_thumb->setMuted(!on);
    m_name->setEnabled(on);
    QFont font = m_name->font();
    font.setStrikeOut(!on);
    m_name->setFont(font);
}

void TermTile::setWhyEmpty(const QString& why) {
    m_thumb->setWhyEmpty(why);
    if (!m_open)
        return;
    m_open->setEnabled(why.isEmpty());
    m_open->setToolTip(why.isEmpty() ? m_open->statusTip() : why);
}

} // namespace patina::editor
