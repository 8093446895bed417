// A part of the equation bar: a thumbnail, the way to what it is made of, and for the terms of the
// picture's sum whether they are part of it.
#pragma once

#include "core/document/Views.h"

#include <QWidget>
#include <optional>

class QLabel;
class QToolButton;

namespace patina::editor {

class ViewThumb;

class TermTile : public QWidget {
    Q_OBJECT
  public:
    struct Abilities {
        bool switches = false; // it can be taken out of the picture
        bool opens = false;    // it is made of others
    };
    TermTile(ViewKind kind, const QString& caption, Abilities abilities, QWidget* parent = nullptr);

    [[nodiscard]] ViewThumb& thumb() { return *m_thumb; }
    [[nodiscard]] const ViewThumb& thumb() const { return *m_thumb; }
    void setOn(bool on, bool alone); // part of the picture; the only one that is
    void setWhyEmpty(const QString& why);

  Q_SIGNALS:
    void switched(bool on);
    void soloClicked();
    void opened();

  private:
    QToolButton* makeButton(const QString& id, const QString& name, const QString& sentence);

    ViewThumb* m_thumb;
    QLabel* m_name;
    QToolButton *m_on = nullptr, *m_solo = nullptr, *m_open = nullptr; // where it is able to
    std::optional<bool> m_isOn;
};

} // namespace patina::editor
