// What the Light lab says: its sections, the captions of its pictures and numbers as it writes
// them.
#pragma once

#include "app/editor/panel/LabLight.h"

#include <QString>
#include <vector>

namespace patina::editor {

struct LabSection {
    QString name, help;
    std::vector<LabView> views; // in the order of the contact sheet
};
[[nodiscard]] std::vector<LabSection> labSections();

struct LabCaption {
    QString title, detail;
    QString warning; // empty: nothing to warn of
};
// `whole`: with all there is to say, for the large picture. `irradianceError`: of the light's maps.
[[nodiscard]] LabCaption labCaption(LabView view, bool whole, const LabLight& light,
                                    double irradianceError);

// Numbers with a real minus sign: significant digits, or decimals.
[[nodiscard]] QString labNumber(double value);
[[nodiscard]] QString labFixed(double value, int decimals);
[[nodiscard]] QString labColor(const glm::vec3& color); // three numbers

} // namespace patina::editor
