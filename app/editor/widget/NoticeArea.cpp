#include "app/editor/widget/NoticeArea.h"

#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/EditControl.h"

#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QPlainTextEdit>
#include <QToolButton>
#include <QVBoxLayout>
#include <QVariantAnimation>
#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kMaxBars = 2;
constexpr int kMaxWidth = 720;
constexpr int kMostOfPicture = 4; // two bars cover at most a quarter of its height
constexpr int kInfoMs = 6000;     // information goes by itself, problems wait for the user
constexpr int kFadeMs = 500;
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

// The last `parts` names of a path: "bike/scene.gltf" for two.
QString tail(const QString& file, int parts) {
    return file.section(QLatin1Char('/'), -parts);
}

} // namespace

NoticeBar::NoticeBar(const UserNotice& notice, const QString& name, QWidget* parent)
    : QFrame(parent)
    , m_notice(notice)
    , m_fileName(name)
    , m_text(new QLabel) {
    setObjectName(QStringLiteral("notice"));
    setAttribute(Qt::WA_NoMousePropagation); // below it is the viewport
    refreshText();
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
        m_more = new QToolButton;
        m_more->setText(tr("Details…"));
        m_more->setCheckable(true);
        m_more->setAccessibleName(tr("Show the details of the notice"));
        auto* details = new QPlainTextEdit(notice.details.join(QLatin1Char('\n')));
        details->setReadOnly(true);
        details->setLineWrapMode(QPlainTextEdit::NoWrap);
        details->setAccessibleName(tr("Details"));
        const int lines = std::clamp<int>(static_cast<int>(notice.details.size()), 1, kDetailLines);
        details->setFixedHeight(lines * fontMetrics().lineSpacing() + 22);
        details->hide();
        connect(m_more, &QToolButton::toggled, details, &QWidget::setVisible);
        grid->addWidget(m_more, 0, 2);
        grid->addWidget(details, 1, 1, 1, 3);
    }
    if (notice.kind == NoticeKind::Info) {
        m_life.setSingleShot(true);
        m_life.setInterval(kInfoMs);
        connect(&m_life, &QTimer::timeout, this, &NoticeBar::fade);
        m_life.start();
    }
}

QString NoticeBar::text() const {
    return m_text->text();
}

void NoticeBar::setFileName(const QString& name) {
    m_fileName = name;
    refreshText();
}

void NoticeBar::countOnceMore() {
    ++m_count;
    stopFading();
    if (m_life.interval() > 0)
        m_life.start();
    refreshText();
}

void NoticeBar::refreshText() {
    QString text = m_notice.text;
    const QString plain = tail(m_notice.file, 1);
    const qsizetype at = text.contains(m_notice.file) ? -1 : text.indexOf(plain);
    if (!plain.isEmpty() && at >= 0)
        text.replace(at, plain.size(), m_fileName);
    m_text->setText(m_count == 1 ? text : tr("%1 (%2 times)").arg(text).arg(m_count));
    setAccessibleName(m_text->text());
}

void NoticeBar::fade() {
    if (underMouse() || (m_more && m_more->isChecked())) {
        m_life.start();
        return;
    }
    if (!isVisible() || size().isEmpty()) { // there was no room for it
        Q_EMIT faded();
        return;
    }
    // A picture of itself, for its parts have no opacity.
    m_fading = grab();
    setFixedSize(size());
    for (QWidget* part : findChildren<QWidget*>(Qt::FindDirectChildrenOnly))
        part->setVisible(false);
    m_fade = new QVariantAnimation(this);
    m_fade->setDuration(kFadeMs);
    m_fade->setStartValue(1.0);
    m_fade->setEndValue(0.0);
    connect(m_fade, &QVariantAnimation::valueChanged, this, qOverload<>(&QWidget::update));
    connect(m_fade, &QVariantAnimation::finished, this, &NoticeBar::faded);
    m_fade->start();
}

void NoticeBar::stopFading() {
    if (!m_fade)
        return;
    delete std::exchange(m_fade, nullptr);
    m_fading = QPixmap();
    setMinimumSize(0, 0);
    setMaximumSize(QWIDGETSIZE_MAX, QWIDGETSIZE_MAX);
    for (QWidget* part : findChildren<QWidget*>(Qt::FindDirectChildrenOnly))
        part->setVisible(!qobject_cast<QPlainTextEdit*>(part)); // details are folded then
    update();
}

void NoticeBar::paintEvent(QPaintEvent* event) {
    if (!m_fade) {
        QFrame::paintEvent(event);
        return;
    }
    QPainter painter(this);
    painter.setOpacity(m_fade->currentValue().toDouble());
    painter.drawPixmap(0, 0, m_fading);
}

NoticeArea::NoticeArea(QWidget& picture)
    : QWidget(&picture)
    , m_picture(picture)
    , m_layout(new QVBoxLayout(this)) {
    setAttribute(Qt::WA_NoMousePropagation);
    m_layout->setContentsMargins(0, 0, 0, 0);
    m_layout->setSpacing(4);
    picture.installEventFilter(this);
    hide();
}

// With as many folders as tell it from the other files of its name.
QString NoticeArea::nameOf(const QString& file) const {
    int parts = 1;
    const auto ambiguous = [&](const QString& other) {
        return other != file && tail(other, parts) == tail(file, parts);
    };
    while (tail(file, parts) != file && std::any_of(m_files.begin(), m_files.end(), ambiguous))
        ++parts;
    return tail(file, parts);
}

void NoticeArea::add(const UserNotice& notice) {
    // What somebody has read and sent away is not news when the scene is opened or edited again. An
    // error is: it answers what was just tried.
    const QString told = notice.file + QLatin1Char('\n') + notice.text;
    if (notice.kind == NoticeKind::Warning && m_dismissed.contains(told))
        return;
    if (!notice.file.isEmpty())
        m_files << notice.file;
    for (NoticeBar* bar : std::as_const(m_bars))
        bar->setFileName(nameOf(bar->notice().file));
    for (NoticeBar* bar : std::as_const(m_bars)) {
        const UserNotice& shown = bar->notice();
        if (shown.text == notice.text && shown.details == notice.details &&
            shown.file == notice.file) {
            bar->countOnceMore();
            return;
        }
    }
    auto* bar = new NoticeBar(notice, nameOf(notice.file));
    connect(bar, &NoticeBar::faded, this, [=, this] { remove(bar); });
    connect(bar, &NoticeBar::dismissed, this, [=, this] {
        m_dismissed << told;
        remove(bar);
    });
    m_bars.prepend(bar);
    m_layout->insertWidget(0, bar);
    if (m_bars.size() > kMaxBars)
        remove(m_bars.last());
    raise();
    showBars();
}

bool NoticeArea::waits(const NoticeBar& bar) const {
    return m_traced && bar.notice().about == NoticeAbout::Drawing;
}

void NoticeArea::setTraced(bool traced) {
    if (std::exchange(m_traced, traced) != traced)
        showBars();
}

void NoticeArea::showBars() {
    for (NoticeBar* bar : std::as_const(m_bars))
        if (waits(*bar))
            bar->hide(); // the others as there is room
    setVisible(!std::ranges::all_of(std::as_const(m_bars),
                                    [this](const NoticeBar* bar) { return waits(*bar); }));
    place();
}

void NoticeArea::sceneReplaced(bool byStartScene) {
    for (NoticeBar* bar : QList<NoticeBar*>(m_bars)) {
        const NoticeAbout about = bar->notice().about;
        if (about == NoticeAbout::Scene || about == NoticeAbout::Drawing ||
            (about == NoticeAbout::UnopenedFile && !byStartScene))
            remove(bar);
    }
}

void NoticeArea::remove(NoticeBar* bar) {
    if (!m_bars.removeOne(bar))
        return;
    m_layout->removeWidget(bar);
    retire(bar);
    showBars();
}

void NoticeArea::place() {
    const int margin = tokens::kMargin;
    const int width = std::min(m_picture.width() - 2 * margin, kMaxWidth);
    // Asked of the bars themselves: the layout keeps what it knew of them before they were shown.
    int wanted = 0;
    for (NoticeBar* bar : std::as_const(m_bars)) {
        if (waits(*bar))
            continue;
        bar->ensurePolished();
        const int height =
            bar->hasHeightForWidth() ? bar->heightForWidth(width) : bar->sizeHint().height();
        const int all = wanted == 0 ? height : wanted + m_layout->spacing() + height;
        const bool fits = wanted == 0 || all <= m_picture.height() / kMostOfPicture;
        bar->setVisible(fits); // the newest always
        if (fits)
            wanted = all;
    }
    QRect room((m_picture.width() - width) / 2, margin, width, m_picture.height() - 2 * margin);
    QRect place = room.adjusted(0, std::max(0, room.height() - wanted), 0, 0);
    if (m_below && m_below->isVisible() && place.intersects(m_below->geometry())) {
        room.setBottom(m_below->y() - tokens::kGap);
        place = room.adjusted(0, std::max(0, room.height() - wanted), 0, 0);
    }
    setGeometry(place);
}

bool NoticeArea::event(QEvent* event) {
    if (event->type() == QEvent::LayoutRequest)
        place(); // a text or the details have grown
    return QWidget::event(event);
}

void NoticeArea::keepClearOf(QWidget& below) {
    m_below = &below;
    below.installEventFilter(this);
    place();
}

bool NoticeArea::eventFilter(QObject* watched, QEvent* event) {
    const QEvent::Type type = event->type();
    if (type == QEvent::Resize ||
        (watched == m_below &&
         (type == QEvent::Move || type == QEvent::Show || type == QEvent::Hide)))
        place();
    return false;
}

} // namespace patina::editor
