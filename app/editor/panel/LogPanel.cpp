#include "app/editor/panel/LogPanel.h"

#include "app/editor/style/Tokens.h"

#include <QFontDatabase>
#include <QPlainTextEdit>
#include <QScrollBar>
#include <QTextCursor>
#include <QTime>
#include <QVBoxLayout>
#include <mutex>

namespace patina::editor {
namespace {
constexpr int kMaxLines = 5000;

QRgb colorOf(LogLevel level) {
    switch (level) {
    case LogLevel::Debug:
        return tokens::kTextOff;
    case LogLevel::Info:
        return tokens::kTextDim;
    case LogLevel::Warning:
        return tokens::kCopper;
    case LogLevel::Error:
        return tokens::kDanger;
    }
    return tokens::kText;
}

} // namespace

struct LogPanel::Outlet {
    std::mutex mutex;
    LogPanel* panel = nullptr;
};

LogPanel::LogPanel(QWidget* parent)
    : QWidget(parent)
    , m_outlet(std::make_shared<Outlet>())
    , m_text(new QPlainTextEdit) {
    m_text->setReadOnly(true);
    m_text->setMaximumBlockCount(kMaxLines);
    m_text->setLineWrapMode(QPlainTextEdit::NoWrap);
    m_text->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    m_text->setAccessibleName(tr("Log"));
    m_text->setPlaceholderText(tr("Nothing has been logged yet."));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(tokens::kGap, 0, tokens::kGap, tokens::kGap);
    layout->addWidget(m_text);
    m_outlet->panel = this;
    setLogListener([outlet = m_outlet](LogLevel level, const std::string& message) {
        const std::lock_guard lock(outlet->mutex);
        if (LogPanel* panel = outlet->panel)
            QMetaObject::invokeMethod(
                panel,
                [panel, level, text = QString::fromStdString(message)] {
                    panel->append(level, text);
                },
                Qt::QueuedConnection);
    });
}

LogPanel::~LogPanel() {
    setLogListener({});
    const std::lock_guard lock(m_outlet->mutex);
    m_outlet->panel = nullptr;
}

void LogPanel::append(LogLevel level, const QString& message) {
    const QScrollBar* bar = m_text->verticalScrollBar();
    const bool follows = bar->value() == bar->maximum() && !m_text->textCursor().hasSelection();
    m_text->appendHtml(QStringLiteral("<span style='color:%1'>%2</span> "
                                      "<span style='color:%3'>%4</span>")
                           .arg(QColor(tokens::kTextOff).name(),
                                QTime::currentTime().toString(QStringLiteral("HH:mm:ss")),
                                QColor(colorOf(level)).name(), message.toHtmlEscaped()));
    if (!follows)
        return;
    // The last line from its beginning: at its end the view would be scrolled to the far right.
    QTextCursor last = m_text->textCursor();
    last.movePosition(QTextCursor::End);
    last.movePosition(QTextCursor::StartOfBlock);
    m_text->setTextCursor(last);
}

} // namespace patina::editor
