// The row of view.bounces: from none at the left end to "as baked (3)" at the right one.
#pragma once

#include "app/editor/panel/ParameterRow.h"

namespace patina::editor {

class NumberField;
class Slider;

class BouncesRow : public ParameterRow {
  public:
    BouncesRow(const ParameterInfo& info, const RowContext& context);

  protected:
    void show(const ParameterValue& value) override;

  private:
    // Shown are 0 for none, and the bake's own number for "as baked"; stored are -1 and 0.
    [[nodiscard]] float stored(double shown) const;

    Slider* m_slider;
    NumberField* m_field;
};

} // namespace patina::editor
