#include "app/editor/VisualSceneQuestion.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SourceName.h"
#include "app/editor/style/Tokens.h"
#include "core/base/PrintableText.h"
#include "core/document/SceneSource.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

namespace patina::editor {

VisualSceneQuestion::VisualSceneQuestion(DocumentController& controller, QWidget& window)
    : QObject(&window)
    , m_window(window) {
    connect(&controller, &DocumentController::severalScenesFound, this, &VisualSceneQuestion::ask);
}

void VisualSceneQuestion::ask(const QString& file, const QStringList& titles, int opened) {
    if (m_question)
        m_question->close(); // about a scene that is open no more
    m_question = new QDialog(&m_window);
    m_question->setObjectName(QStringLiteral("visualSceneQuestion"));
    m_question->setWindowTitle(tr("Choose a Visual Scene"));
    m_question->setAttribute(Qt::WA_DeleteOnClose);
    auto* layout = new QVBoxLayout(m_question);
    layout->setContentsMargins(20, 20, 20, 20);
    layout->setSpacing(tokens::kMargin);
    auto* text = new QLabel(tr("%1 holds %2 visual scenes. The one that the file names is open.")
                                .arg(sourceName(file))
                                .arg(titles.size()));
    text->setTextFormat(Qt::PlainText); // names come from files
    text->setWordWrap(true);
    layout->addWidget(text);
    auto* list = new QListWidget;
    list->setObjectName(QStringLiteral("visualScenes"));
    list->setAccessibleName(tr("Visual scenes"));
    list->setMinimumSize(360, 160);
    for (int i = 0; i < titles.size(); ++i) {
        const QString title = QString::fromStdString(printableLine(titles[i].toStdString()));
        list->addItem(i == opened ? tr("%1 (open)").arg(title) : title);
    }
    list->setCurrentRow(opened);
    layout->addWidget(list);
    auto* buttons = new QDialogButtonBox;
    QPushButton* open = buttons->addButton(tr("&Open Scene"), QDialogButtonBox::AcceptRole);
    open->setToolTip(tr("Opens the chosen visual scene instead"));
    open->setEnabled(false);
    QPushButton* keep = buttons->addButton(tr("&Keep"), QDialogButtonBox::RejectRole);
    keep->setToolTip(tr("Goes on with the scene that is open"));
    keep->setDefault(true);
    layout->addWidget(buttons);
    connect(list, &QListWidget::currentRowChanged, open,
            [open, opened](int row) { open->setEnabled(row >= 0 && row != opened); });
    connect(list, &QListWidget::itemActivated, m_question, [open] { open->click(); });
    connect(buttons, &QDialogButtonBox::rejected, m_question, &QDialog::reject);
    connect(buttons, &QDialogButtonBox::accepted, m_question, &QDialog::accept);
    connect(m_question, &QDialog::accepted, this, [this, file, titles, list] {
        const QString title = titles.at(list->currentRow());
        Q_EMIT chosen(
            QString::fromStdString(formatSceneSource({file.toStdString(), title.toStdString()})));
    });
    m_question->open();
}

} // namespace patina::editor
