// The rows of one scope, generated from the parameter table and grouped under its headings.
#pragma once

#include "app/editor/panel/ParameterRow.h"

#include <QWidget>
#include <functional>
#include <vector>

namespace patina::editor {

class Section;

// Which parameters a list shows.
struct ParameterListSpec {
    Scope scope = Scope::View;
    std::function<std::optional<Target>()> target; // nothing: no element is selected
    std::vector<std::string_view> without;         // ids that the panel shows in another way
    bool loneHeading = false;                      // a lone group has a heading, too
    // Of another list of the dock, whose labels stand in the same column.
    std::optional<Scope> alignedWith = std::nullopt;
};

class ParameterList : public QWidget {
    Q_OBJECT
  public:
    ParameterList(DocumentController& controller, Thumbnails& thumbnails, ParameterListSpec spec,
                  QWidget* parent = nullptr);

    void refresh(); // everything, e.g. when another element is selected
    [[nodiscard]] ParameterRow* row(std::string_view id) const;
    // Puts a widget of the panel's own under the row of a parameter, which the list must show.
    void addBelow(std::string_view id, QWidget* widget);

  private:
    void documentChanged(const Change& change);
    void refreshVisibility();

    DocumentController& m_controller;
    ParameterListSpec m_spec;
    std::vector<ParameterRow*> m_rows;
    std::vector<std::pair<Section*, std::vector<ParameterRow*>>> m_sections;
};

} // namespace patina::editor
