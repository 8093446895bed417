// Asks once for each model file, and of a project once for each picture, whether pictures outside
// its folder may be read (core/scene/OutsidePictures.h), and reads them when the user agrees.
#pragma once

#include "core/scene/OutsidePictures.h"

#include <QObject>
#include <QPointer>
#include <QStringList>
#include <functional>
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
    void askAboutModel(const std::string& model, const std::vector<std::string>& pictures);
    void askAboutProject(const std::vector<std::string>& pictures);
    void ask(const QString& title, const QString& text, const QString& explanation,
             const std::vector<std::string>& pictures, const std::function<void()>& agree);
    void agreeToModel(const std::string& model, const std::vector<std::string>& pictures);
    void agreeToProject(const std::vector<std::string>& pictures);
    void read(const QString& key, const std::vector<std::string>& pictures);

    Session& m_session;
    QWidget& m_window;
    QPointer<QMessageBox> m_question;
    QStringList m_asked;                       // models, in this run
    std::vector<std::string> m_askedOfProject; // pictures, the same
};

} // namespace patina::editor
