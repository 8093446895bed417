// Why views have nothing to show, where a light is chosen, and what would help.
#pragma once

#include "core/base/Id.h"
#include "core/document/Document.h"
#include "core/document/Views.h"

namespace patina {

// whyEmpty(kind, document) of core/document/Views.h, the factors of direct light being those of
// `light`, an id of Document::lights; 0, or one that is not active: of all.
[[nodiscard]] std::string whyEmpty(ViewKind kind, const Document& document, Id light);

// The one step that would make a view apply which does not; None where it applies, or where no
// single step does.
enum class ViewRemedy { None, AddLight, BakeTransfer, BakeBounces };
[[nodiscard]] ViewRemedy viewRemedy(ViewKind kind, const Document& document);

} // namespace patina
