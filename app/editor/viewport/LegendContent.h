// What the legend of a view says, as plain values: names, colours, why there is nothing to see.
#pragma once

#include "core/edit/ViewReasons.h"
#include "render/view/ViewSettings.h"

#include <QColor>
#include <QString>
#include <vector>

namespace patina {
struct Document;
}

namespace patina::editor {

struct LegendContent {
    struct Swatch {
        QColor color;
        QString name;
        friend bool operator==(const Swatch&, const Swatch&) = default;
    };
    struct LightChoice {
        Id id = 0; // 0: the mirror direction
        QString name;
        friend bool operator==(const LightChoice&, const LightChoice&) = default;
    };

    ViewKind kind = shading::kViewFinal;
    QString symbol, title, unit;
    QString help; // a sentence or two, for the tool tip
    QString note; // how numbers became colours, where no scale says it
    QString why;  // why the view does not apply; then nothing below is there but the lights
    ViewRemedy remedy = ViewRemedy::None; // what would help
    bool hasModes = false;                // raw and contribution
    bool contribution = false;            // which of them is shown
    bool hasScale = false;                // a colour map over a range
    std::vector<Swatch> swatches;
    int moreSwatches = 0;            // that found no room
    std::vector<LightChoice> lights; // whose D, G, F …; empty: the view depends on none
    Id light = 0;                    // the chosen one

    friend bool operator==(const LegendContent&, const LegendContent&) = default;
};

[[nodiscard]] LegendContent describeView(const render::ViewSettings& settings,
                                         const render::ViewChoice& choice,
                                         const Document& document);

} // namespace patina::editor
