// How the rows of the parameter table reach the members of a document's elements; only
// Parameters.cpp needs this.
#pragma once

#include "core/base/Check.h"
#include "core/document/Document.h"
#include "core/edit/Parameters.h"
#include "core/material/Material.h"

#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

namespace patina {

// --- The element of a document that a scope and an id name ---

template <class Element>
struct ElementOf;

template <>
struct ElementOf<Material> {
    static constexpr Scope kScope = Scope::Material;
    template <class Doc>
    static auto* find(Doc& document, Id id) {
        return document.material(id);
    }
};
template <>
struct ElementOf<Light> {
    static constexpr Scope kScope = Scope::Light;
    template <class Doc>
    static auto* find(Doc& document, Id id) {
        return document.light(id);
    }
};
template <>
struct ElementOf<MeshInstance> {
    static constexpr Scope kScope = Scope::Mesh;
    template <class Doc>
    static auto* find(Doc& document, Id id) {
        return document.mesh(id);
    }
};
template <>
struct ElementOf<Environment> {
    static constexpr Scope kScope = Scope::Environment;
    template <class Doc>
    static auto* find(Doc& document, Id id) {
        return document.environment(id);
    }
};
template <>
struct ElementOf<EnvironmentMix> {
    static constexpr Scope kScope = Scope::Environment;
    template <class Doc>
    static auto* find(Doc& document, Id) {
        return &document.mix;
    }
};
template <>
struct ElementOf<Softbox> {
    static constexpr Scope kScope = Scope::Softbox;
    template <class Doc>
    static auto* find(Doc& document, Id id) {
        return document.softbox(id);
    }
};
template <>
struct ElementOf<ShadingModel> {
    static constexpr Scope kScope = Scope::Model;
    template <class Doc>
    static auto* find(Doc& document, Id) {
        return &document.model;
    }
};
template <>
struct ElementOf<View> {
    static constexpr Scope kScope = Scope::View;
    template <class Doc>
    static auto* find(Doc& document, Id) {
        return &document.view;
    }
};

// --- Access through member pointers: <&View::camera, &Camera::fovDeg> ---

template <class Member>
struct MemberOwner;
template <class Owner, class Field>
struct MemberOwner<Field Owner::*> {
    using Type = Owner;
};

template <auto First, auto... Rest>
struct Path {
    using Element = typename MemberOwner<decltype(First)>::Type;
    template <class E>
    static auto& in(E& element) {
        if constexpr (sizeof...(Rest) == 0)
            return element.*First;
        else
            return Path<Rest...>::in(element.*First);
    }
};

// How a member travels in a ParameterValue: choices and references as int, counts as float, the
// rest as it is.
template <class Field>
using Stored = std::conditional_t<std::is_enum_v<Field> || std::is_same_v<Field, Id>, int,
                                  std::conditional_t<std::is_same_v<Field, int>, float, Field>>;

template <class P>
ParameterValue getMember(const Document& document, Id id) {
    const auto* element = ElementOf<typename P::Element>::find(document, id);
    CHECK(element != nullptr);
    const auto& field = P::in(*element);
    using Field = std::remove_cvref_t<decltype(field)>;
    return ParameterValue(std::in_place_type<Stored<Field>>, static_cast<Stored<Field>>(field));
}

template <class P>
void setMember(Document& document, Id id, const ParameterValue& value) {
    auto* element = ElementOf<typename P::Element>::find(document, id);
    CHECK(element != nullptr);
    auto& field = P::in(*element);
    using Field = std::remove_cvref_t<decltype(field)>;
    CHECK(std::holds_alternative<Stored<Field>>(value));
    if constexpr (std::is_same_v<Field, int>)
        field = static_cast<int>(std::lround(std::get<float>(value)));
    else
        field = static_cast<Field>(std::get<Stored<Field>>(value));
}

} // namespace patina
