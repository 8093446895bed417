// Keeps the view of OpenColorIO that the document asks for, read in the background: what the
// configuration offers and the one that is shown. Nothing is read while the document is shown
// through a curve of our own.
#pragma once

#include "app/editor/document/UserNotice.h"
#include "core/io/DisplayTransform.h"
#include "core/job/TaskRunner.h"

#include <QObject>
#include <optional>

namespace patina::editor {

class DocumentController;

class DisplayLoader : public QObject {
    Q_OBJECT
  public:
    explicit DisplayLoader(DocumentController& controller, QObject* parent = nullptr);

    // Of the configuration in force; nothing while it is not wanted, not read yet or broken.
    [[nodiscard]] const std::optional<DisplayMenu>& menu() const { return m_menu; }
    // Null likewise. While another view is being read, the last one stays.
    [[nodiscard]] DisplayTransformPtr transform() const { return m_transform; }
    [[nodiscard]] QString problem() const { return m_problem; } // why there is none, or empty

    // For what the graphics driver says of transform().
    void refuse(const Error& error);

  Q_SIGNALS:
    void changed();
    void noticed(const patina::editor::UserNotice& notice);

  private:
    struct Request {
        bool wanted = false;
        std::string config, display, view;
        friend bool operator==(const Request&, const Request&) = default;
    };
    void refresh();
    void fail(const Error& error);

    DocumentController& m_controller;
    Request m_request;
    std::optional<DisplayMenu> m_menu;
    DisplayTransformPtr m_transform;
    QString m_problem;
    TaskGroup m_tasks; // last: ends before what its results are put into
};

} // namespace patina::editor
