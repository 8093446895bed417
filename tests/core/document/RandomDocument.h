// Documents with random but valid values everywhere, without payloads: what a project file holds.
#pragma once

#include "core/document/Document.h"
#include "core/edit/Parameters.h"
#include "core/material/Material.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace patina {

class RandomDocument {
  public:
    explicit RandomDocument(std::uint32_t seed)
        : m_random(seed) {}

    Document make() {
        Document document;
        document.nextId += static_cast<Id>(below(1000));
        for (std::size_t i = below(5); i > 0; --i) {
            skipIds(document);
            document.materials.emplace_back().id = document.takeId();
        }
        for (std::size_t i = below(4); i > 0; --i) {
            skipIds(document);
            document.lights.emplace_back().id = document.takeId();
        }
        for (std::size_t i = below(3); i > 0; --i) {
            skipIds(document);
            document.environments.emplace_back().id = document.takeId();
        }
        for (std::size_t i = below(4); i > 0; --i) {
            skipIds(document);
            document.environments[below(document.environments.size())].softboxes.emplace_back().id =
                document.takeId();
        }
        for (std::size_t i = below(6); i > 0; --i) {
            MeshInstance& mesh = document.meshes.emplace_back();
            mesh.id = document.takeId();
            mesh.source = source();
            mesh.sourceIndex = static_cast<int>(below(1000));
            glm::mat4 transform;
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 4; ++row)
                    transform[column][row] = anyFloat();
            mesh.placement = transform;
        }
        document.view.camera.target = {anyFloat(1e6f), anyFloat(1e6f), anyFloat(1e6f)};
        document.view.camera.yawDeg = between(-1000.0f, 1000.0f);
        document.view.camera.pitchDeg = between(-89.0f, 89.0f);
        document.view.camera.distance = between(1e-3f, 1e4f);
        for (const ParameterInfo& info : parameters())
            for (const Id id : idsOf(document, info.scope))
                info.set(document, id, value(info, document));
        if (document.mix.second == document.mix.first)
            document.mix.second = 0;
        return document;
    }

    std::size_t below(std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(m_random);
    }
    float between(float min, float max) {
        return std::clamp(std::uniform_real_distribution<float>(min, max)(m_random), min, max);
    }
    // Any finite float: every exponent, subnormal numbers too.
    float anyFloat(float largest = std::numeric_limits<float>::max()) {
        while (true) {
            const float number = std::bit_cast<float>(static_cast<std::uint32_t>(m_random()));
            if (std::isfinite(number) && std::abs(number) <= largest)
                return number;
        }
    }

    ParameterValue value(const ParameterInfo& info, const Document& document) {
        switch (info.type) {
        case ParameterType::Bool:
            return below(2) == 0;
        case ParameterType::Float:
            return between(info.hardMin, info.hardMax);
        case ParameterType::Color:
        case ParameterType::Vector:
            return glm::vec3(between(info.hardMin, info.hardMax),
                             between(info.hardMin, info.hardMax),
                             between(info.hardMin, info.hardMax));
        case ParameterType::Choice:
            return static_cast<int>(below(info.choices.size()));
        case ParameterType::Text:
            return name();
        case ParameterType::Map:
            return map(info.scope == Scope::Material);
        case ParameterType::Reference:
            if (info.refersTo == Scope::Environment)
                return info.mayBeNone && below(2) == 0
                           ? 0
                           : static_cast<int>(
                                 document.environments[below(document.environments.size())].id);
            return document.materials.empty() || below(4) == 0
                       ? 0
                       : static_cast<int>(document.materials[below(document.materials.size())].id);
        }
        return false;
    }

    // Of all elements of a scope.
    static std::vector<Id> idsOf(const Document& document, Scope scope) {
        std::vector<Id> ids;
        const auto collect = [&](const auto& elements) {
            for (const auto& element : elements)
                ids.push_back(element.id);
        };
        switch (scope) {
        case Scope::Material:
            collect(document.materials);
            break;
        case Scope::Light:
            collect(document.lights);
            break;
        case Scope::Mesh:
            collect(document.meshes);
            break;
        case Scope::Softbox:
            for (const Environment& environment : document.environments)
                collect(environment.softboxes);
            break;
        case Scope::Environment:
            ids.push_back(0);
            collect(document.environments);
            break;
        case Scope::Model:
        case Scope::View:
            ids.push_back(0);
        }
        return ids;
    }

  private:
    void skipIds(Document& document) { document.nextId += static_cast<Id>(below(3)); }

    std::string name() {
        const char* names[] = {"Body",
                               "",
                               "näme \xf0\x9f\x8e\xa8",
                               "a\"b\\c/d",
                               "line\nbreak",
                               "[x].y{},:null",
                               "\x01",
                               "100%25 sure"};
        return names[below(std::size(names))];
    }

    // Also names that are no UTF-8, hold percent signs, or look like something else.
    std::string source() {
        const char* sources[] = {
            "",
            "builtin:wood/baseColor",
            "/home/artist/project/textures/wood.png",
            "/home/artist/other/wood.png",
            "/wood.png",
            "/home/artist/project/builtin:sphere",
            "/home/artist/project/r\xe9sum\xe9.png",
            "/home/artist/project/100%.png",
            "/home/artist/project/%41%zz%.png",
            "/home/artist/project/a \"b\"\n.png",
            "/home/artist/project/chair.glb#embedded:3",
            "/home/artist/project/\xff\xfe/\xf0\x9f\x8e\xa8.exr",
        };
        return sources[below(std::size(sources))];
    }

    MapSlot map(bool hasAdjustments) {
        MapSlot slot;
        if (below(3) == 0)
            return slot;
        slot.source = source();
        if (!hasAdjustments)
            return slot;
        slot.channel = static_cast<MapChannel>(below(5));
        if (below(2) == 0) {
            slot.uvScale = {anyFloat(), anyFloat()};
            slot.uvOffset = {anyFloat(), anyFloat()};
            slot.uvRotationDeg = anyFloat();
        }
        return slot;
    }

    std::mt19937 m_random;
};

} // namespace patina
