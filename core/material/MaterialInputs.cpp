#include "core/material/MaterialInputs.h"

namespace patina {

PerInput<float> defaultNumbers() {
    const Material material;
    PerInput<float> numbers;
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (info.number != nullptr)
            numbers[info.input] = material.*info.number;
    return numbers;
}

} // namespace patina
