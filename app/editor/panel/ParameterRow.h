// One row of a panel: label + getter + pusher. It stores nothing: what it shows comes from the
// document, what the user does goes to the controller.
#pragma once

#include "app/editor/document/DocumentController.h"
#include "core/edit/Parameters.h"

#include <QWidget>
#include <functional>
#include <optional>

class QHBoxLayout;

namespace patina::editor {

class RowLabel;
class Thumbnails;

// What rows need to know of their panel.
struct RowContext {
    DocumentController& controller;
    Thumbnails& thumbnails;
    std::function<std::optional<Target>()> target; // nothing: no element is selected
    int labelWidth = 0;
};

class ParameterRow : public QWidget {
    Q_OBJECT
  public:
    ParameterRow(const ParameterInfo& info, const RowContext& context);

    [[nodiscard]] const ParameterInfo& info() const { return m_info; }
    void refresh();            // shows the document's value
    void setWorks(bool works); // false: shown but disabled, because it has no effect now

  protected:
    virtual void show(const ParameterValue& value) = 0;

    // For the widgets of derived rows: one undo step per drag, one for each other edit. Steps of
    // the wheel or the arrow keys that follow each other quickly are one.
    void beginDrag();
    void drag(const ParameterValue& value);
    void endDrag();
    void edit(const ParameterValue& value);
    void step(const ParameterValue& value);

    [[nodiscard]] std::optional<ParameterValue> current() const;
    [[nodiscard]] std::optional<Target> target() const { return m_context.target(); }
    [[nodiscard]] const RowContext& context() const { return m_context; }
    void addField(QWidget* field, int stretch = 0); // right of the label; help and name are set
    void describe(QWidget* field, const QString& suffix = {}) const;

  private:
    const ParameterInfo& m_info; // of the static table
    RowContext m_context;
    RowLabel* m_label;
    QHBoxLayout* m_layout;
    bool m_works = true;
    std::optional<Target> m_shown; // whose value the row shows, and whose edits it reports
    DragSession m_session = 0, m_stepSession = 0;
    qint64 m_lastStepMs = 0;
};

// The row that suits the parameter's type; null for names and references.
[[nodiscard]] ParameterRow* makeParameterRow(const ParameterInfo& info, const RowContext& context);

} // namespace patina::editor
