// The split between two views, as its handle moves it.
#pragma once

#include "app/editor/viewport/SplitHandle.h"

namespace patina::editor {

class ViewState;

class ViewSplitModel : public SplitModel {
    Q_OBJECT
  public:
    explicit ViewSplitModel(ViewState& views, QObject* parent = nullptr);

    [[nodiscard]] std::optional<render::ViewSplit> line() const override;
    void moveLine(const render::ViewSplit& line) override;
    void removeLine() override;
    [[nodiscard]] QString leftName() const override;
    [[nodiscard]] QString rightName() const override;

  private:
    ViewState& m_views;
};

} // namespace patina::editor
