#include "app/editor/widget/NoticeArea.h"

#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/EditControl.h"

#include <QGridLayout>
#include <QLabel>
#include <QPlainTextEdit>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kMaxBars = 4;      // older ones give way; the log keeps them
constexpr int kInfoSeconds = 12; // information goes by itself, problems wait for the user
constexpr int kDetailLines = 8;

QIcon iconOf(NoticeKind kind) {
    switch (kind) {
    case NoticeKind::Info:
        return icon(QStringLiteral("info"), tokens::kAccent);
    case NoticeKind::Warning:
        return icon(QStringLiteral("warning"), tokens::kCopper);
    case NoticeKind::Error:
        return icon(QStringLiteral("error"), tokens::kDanger);
    }
    return {};
}

} // namespace

NoticeBar::NoticeBar(const UserNotice& notice, QWidget* parent)
    : QFrame(parent)
    , m_notice(notice)
    , m_text(new QLabel(notice.text)) {
    setObjectName(QStringLiteral("notice"));
    setAccessibleName(notice.text);
    auto* sign = new QLabel;
    sign->setPixmap(iconOf(notice.kind).pixmap(QSize(18, 18), devicePixelRatioF()));
    m_text->setWordWrap(true);
    m_text->setTextFormat(Qt::PlainText);
    m_text->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* dismiss = new QToolButton;
    dismiss->setIcon(icon(QStringLiteral("close")));
    dismiss->setIconSize({14, 14});
    dismiss->setToolTip(tr("Dismiss"));
    dismiss->setAccessibleName(tr("Dismiss the notice"));
    connect(dismiss, &QToolButton::clicked, this, &NoticeBar::dismissed);

    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(tokens::kMargin, 6, 6, 6);
    grid->setHorizontalSpacing(tokens::kGap);
    grid->addWidget(sign, 0, 0);
    grid->addWidget(m_text, 0, 1);
    grid->addWidget(dismiss, 0, 3);
    grid->setColumnStretch(1, 1);

    if (!notice.details.isEmpty()) {
        auto* more = new QToolButton;
        more->setText(tr("Details…"));
        more->setCheckable(true);
        more->setAccessibleName(tr("Show the details of the notice"));
        auto* details = new QPlainTextEdit(notice.details.join(QLatin1Char('\n')));
        details->setReadOnly(true);
        details->setLineWrapMode(QPlainTextEdit::NoWrap);
        details->setAccessibleName(tr("Details"));
        const int lines = std::clamp<int>(static_cast<int>(notice.details.size()), 1, kDetailLines);
        details->setFixedHeight(lines * fontMetrics().lineSpacing() + 22);
        details->hide();
        connect(more, &QToolButton::toggled, details, &QWidget::setVisible);
        grid->addWidget(more, 0, 2);
        grid->addWidget(details, 1, 1, 1, 3);
    }
    if (notice.kind == NoticeKind::Info)
        QTimer::singleShot(kInfoSeconds * 1000, this, &NoticeBar::dismissed);
}

void NoticeBar::countOnceMore() {
    ++m_count;
    m_text->setText(tr("%1 (%2 times)").arg(m_notice.text).arg(m_count));
}

NoticeArea::NoticeArea(QWidget* parent)
    : QWidget(parent)
    , m_layout(new QVBoxLayout(this)) {
    m_layout->setContentsMargins(0, 0, 0, 0);
    m_layout->setSpacing(1);
    hide();
}

void NoticeArea::add(const UserNotice& notice) {
    for (NoticeBar* bar : std::as_const(m_bars)) {
        if (bar->notice().text == notice.text && bar->notice().details == notice.details) {
            bar->countOnceMore();
            return;
        }
    }
    auto* bar = new NoticeBar(notice);
    connect(bar, &NoticeBar::dismissed, this, [=, this] { remove(bar); });
    m_bars.prepend(bar);
    m_layout->insertWidget(0, bar);
    if (m_bars.size() > kMaxBars)
        remove(m_bars.last());
    show();
}

void NoticeArea::remove(NoticeBar* bar) {
    if (!m_bars.removeOne(bar))
        return;
    m_layout->removeWidget(bar);
    retire(bar);
    setVisible(!m_bars.isEmpty());
}

} // namespace patina::editor
