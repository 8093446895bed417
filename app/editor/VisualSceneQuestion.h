// Asks, after a COLLADA file with several visual scenes was opened, which of them is wanted.
#pragma once

#include <QObject>
#include <QPointer>
#include <QStringList>

class QDialog;
class QWidget;

namespace patina::editor {

class DocumentController;

class VisualSceneQuestion : public QObject {
    Q_OBJECT
  public:
    VisualSceneQuestion(DocumentController& controller, QWidget& window);

  Q_SIGNALS:
    void chosen(const QString& scene); // to be opened instead, as of openScene()

  private:
    void ask(const QString& file, const QStringList& titles, int opened);

    QWidget& m_window;
    QPointer<QDialog> m_question;
};

} // namespace patina::editor
