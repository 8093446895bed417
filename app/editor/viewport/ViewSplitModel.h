// The split between two views, as its handle moves it.
#pragma once

#include "app/editor/viewport/SplitHandle.h"

namespace patina::editor {

class TracedSide;
class ViewState;
enum class ViewSide;

class ViewSplitModel : public SplitModel {
    Q_OBJECT
  public:
    ViewSplitModel(ViewState& views, const TracedSide& traced, QObject* parent = nullptr);

    [[nodiscard]] std::optional<render::ViewSplit> line() const override;
    void moveLine(const render::ViewSplit& line) override;
    void removeLine() override;
    [[nodiscard]] QString leftName() const override;
    [[nodiscard]] QString rightName() const override;

  private:
    [[nodiscard]] QString nameOf(const render::ViewChoice& choice, ViewSide side) const;

    ViewState& m_views;
    const TracedSide& m_traced;
    bool m_whitted = false; // the names say so
};

} // namespace patina::editor
