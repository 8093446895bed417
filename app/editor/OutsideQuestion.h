// Asks once for each model file whether pictures that it names outside its own folder may be read
// (core/scene/OutsidePictures.h), and reads them when the user agrees.
#pragma once

#include "core/scene/OutsidePictures.h"

#include <QObject>
#include <QPointer>
#include <QStringList>
#include <string>
#include <vector>

class QMessageBox;
class QWidget;

namespace patina::editor {

struct Session;

class OutsideQuestion : public QObject {
    Q_OBJECT
  public:
    OutsideQuestion(Session& session, QWidget& window);

  private:
    void askIfNeeded();
    void ask(const std::string& model, const std::vector<std::string>& pictures);
    void agree(const std::string& model, const std::vector<std::string>& pictures);

    Session& m_session;
    QWidget& m_window;
    QPointer<QMessageBox> m_question;
    QStringList m_asked; // models, in this run
};

} // namespace patina::editor
