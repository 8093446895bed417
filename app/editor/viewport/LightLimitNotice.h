// Says so in the window when a document has more lights than the picture can show.
#pragma once

#include "app/editor/document/DocumentController.h"

#include <QObject>
#include <QTimer>
#include <string>
#include <vector>

namespace patina::editor {

class LightLimitNotice : public QObject {
    Q_OBJECT
  public:
    explicit LightLimitNotice(DocumentController& controller, QObject* parent = nullptr);

  private:
    void follow(const Change& change);
    void check();

    DocumentController& m_controller;
    QTimer m_later; // once what else happens to the document has
    std::vector<std::string> m_told;
};

} // namespace patina::editor
