#include "app/editor/panel/BouncesRow.h"

#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/Slider.h"
#include "core/edit/Edit.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr float kNone = -1.0f, kAsBaked = 0.0f; // stored

QString asBakedText(int bounces) {
    return BouncesRow::tr("as baked (%1)").arg(bounces);
}

} // namespace

BouncesRow::BouncesRow(const ParameterInfo& info, const RowContext& context)
    : ParameterRow(info, context)
    , m_slider(new Slider(0.0, 1.0, 0.0))
    , m_field(new NumberField({})) {
    constexpr int kMargins = 20; // of a field's text
    m_field->setFixedWidth(fontMetrics().horizontalAdvance(asBakedText(64)) + kMargins);
    addField(m_slider, 1);
    addField(m_field);
    connect(m_slider, &Slider::dragStarted, this, &BouncesRow::beginDrag);
    connect(m_slider, &Slider::dragged, this, [this](double shown) {
        drag(stored(shown));
        refresh(); // the handle stands at whole numbers
    });
    connect(m_slider, &Slider::dragFinished, this, &BouncesRow::endDrag);
    connect(m_field, &NumberField::dragStarted, this, &BouncesRow::beginDrag);
    connect(m_field, &NumberField::dragged, this, [this](double shown) { drag(stored(shown)); });
    connect(m_field, &NumberField::dragFinished, this, &BouncesRow::endDrag);
    connect(m_field, &NumberField::stepped, this, [this](double shown) { step(stored(shown)); });
    connect(m_field, &NumberField::edited, this, [this](double shown) { edit(stored(shown)); });
}

float BouncesRow::stored(double shown) const {
    const int bounces = static_cast<int>(std::lround(shown));
    if (bounces <= 0)
        return kNone;
    return bounces == bakedBounces(context().controller.document()) ? kAsBaked
                                                                    : static_cast<float>(bounces);
}

void BouncesRow::show(const ParameterValue& value) {
    const int baked = bakedBounces(context().controller.document());
    const float bounces = std::get<float>(value);
    const double shown = bounces < 0.0f ? 0.0 : bounces == kAsBaked ? baked : double{bounces};
    const double end = std::max(baked, 1);
    m_slider->setEnds(0.0, end);
    m_slider->setValue(shown);
    m_field->setFormat(
        {0.0, end, 0.0, double{info().hardMax}, 0, false, {}, [baked](double number) {
             return number == 0.0 ? tr("none") : number == baked ? asBakedText(baked) : QString();
         }});
    m_field->setValue(shown);
}

} // namespace patina::editor
