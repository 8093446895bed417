// Leaks and seams of the radiosity solution, the worst first; a click chooses the element.
#pragma once

#include "core/radiosity/document/LeaksAndSeams.h"

#include <QWidget>
#include <memory>

class QLabel;
class QPushButton;
class QTreeWidget;

namespace patina::editor {

class DocumentController;
class RadiosityUpdater;

class LeakList : public QWidget {
    Q_OBJECT
  public:
    static constexpr std::size_t kMostListed = 500; // of each kind

    LeakList(RadiosityUpdater& radiosity, DocumentController& controller,
             QWidget* parent = nullptr);

    void refresh();

  private:
    void list();

    RadiosityUpdater& m_radiosity;
    DocumentController& m_controller;
    QPushButton* m_find;
    QLabel* m_text;
    QTreeWidget* m_list;
    std::shared_ptr<const LeaksAndSeams> m_listed;
};

} // namespace patina::editor
