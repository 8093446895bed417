#include "app/editor/trace/RayTreeTexts.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "core/document/Document.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {

// Colours that are told apart on dark and bright pictures, also without red or green (Okabe & Ito
// 2008).
constexpr QRgb kCameraRay = 0xfff0f0f0, kLitRay = 0xfff0e442, kShadowedRay = 0xffd55e00,
               kReflectedRay = 0xff56b4e9, kRefractedRay = 0xffcc79a7;

QString trRay(const char* text) {
    return QCoreApplication::translate("RayTree", text);
}

QString rayNumber(float value) {
    return QLocale().toString(static_cast<double>(value), 'g', 3);
}

QString rayPlace(const glm::vec3& v) {
    return QStringLiteral("%1  %2  %3").arg(rayNumber(v.x), rayNumber(v.y), rayNumber(v.z));
}

QString rayMeshName(const Document& document, Id id) {
    const MeshInstance* mesh = document.mesh(id);
    return mesh != nullptr ? toQString(mesh->name) : trRay("a mesh that is gone");
}

bool isTinted(const RayNode& node) {
    return node.passes != glm::vec3(1.0f);
}

} // namespace

QColor rayColor(const RayNode& node) {
    if (!wasCast(node.end) && node.end != RayEnd::NoShadow)
        return tokens::kTextOff;
    switch (node.kind) {
    case RayKind::Camera:
        return kCameraRay;
    case RayKind::Shadow:
        return node.end == RayEnd::Lit || node.end == RayEnd::NoShadow ? kLitRay : kShadowedRay;
    case RayKind::Reflected:
        return kReflectedRay;
    case RayKind::Refracted:
        break;
    }
    return kRefractedRay;
}

QString rayName(const Document& document, const RayNode& node, int number, int count) {
    switch (node.kind) {
    case RayKind::Camera:
        return trRay("Camera ray %1 of %2").arg(number).arg(count);
    case RayKind::Shadow:
        break;
    case RayKind::Reflected:
        return trRay("Reflected");
    case RayKind::Refracted:
        return trRay("Refracted");
    }
    const Light* light = document.light(node.light);
    return trRay("To %1").arg(node.glowing != 0  ? rayMeshName(document, node.glowing)
                              : light != nullptr ? toQString(light->name)
                                                 : trRay("a light that is gone"));
}

QString rayMeets(const Document& document, const RayNode& node) {
    if (!wasCast(node.end))
        return {};
    if (node.hit)
        return QStringLiteral("%1, %2 m")
            .arg(rayMeshName(document, node.mesh), rayNumber(node.distance));
    if (node.kind == RayKind::Shadow)
        return std::isinf(node.distance) ? trRay("The light")
                                         : trRay("The light, %1 m").arg(rayNumber(node.distance));
    return trRay("Background");
}

QString rayEnds(const RayNode& node) {
    switch (node.end) {
    case RayEnd::Continues:
        return node.totalReflection ? trRay("Total reflection") : QString();
    case RayEnd::Missed:
        return trRay("Left the scene");
    case RayEnd::NotReflecting:
        return trRay("Does not reflect");
    case RayEnd::Emissive:
        return trRay("Gives off light");
    case RayEnd::Back:
        return trRay("Back of the surface: absorbed");
    case RayEnd::Depth:
        return trRay("Cut: deepest level reached");
    case RayEnd::Contribution:
        return trRay("Cut: adds too little");
    case RayEnd::Below:
        return trRay("Cut: points into the surface");
    case RayEnd::Lit:
        return isTinted(node)
                   ? trRay("Lit through glass, %1 %")
                         .arg(QLocale().toString(
                             100.0 * static_cast<double>(shading::luminance(node.passes)), 'f', 0))
                   : trRay("Lit");
    case RayEnd::Blocked:
        return trRay("In shadow");
    case RayEnd::NoShadow:
        return trRay("Lit: the light casts no shadow");
    case RayEnd::Facing:
        return trRay("Faces away");
    }
    return {};
}

QString rayTerms(const RayNode& node) {
    if (!wasCast(node.end) && node.end != RayEnd::NoShadow)
        return {};
    const RayTerms& terms = node.terms;
    QStringList texts;
    const auto add = [&](const QString& name, const glm::vec3& value) {
        texts << QStringLiteral("%1 %2").arg(name, rayNumber(shading::luminance(value)));
    };
    if (node.kind == RayKind::Reflected)
        add(QStringLiteral("kr"), terms.factor);
    if (node.kind == RayKind::Refracted)
        add(QStringLiteral("kt"), terms.factor);
    if (node.kind == RayKind::Shadow) {
        if (terms.arriving == glm::vec3(0.0f))
            return {};
        add(QStringLiteral("f Ip"), terms.arriving);
        add(QStringLiteral("kd N·L"), terms.diffuse);
        add(QStringLiteral("ks (R·V)ⁿ"), terms.specular);
    } else if (node.hit) {
        add(QStringLiteral("Ia ka"), terms.ambientLight * terms.ambient);
        if (terms.emission != glm::vec3(0.0f))
            add(trRay("emission"), terms.emission);
    }
    return texts.join(QStringLiteral(" · "));
}

QString lightText(const glm::vec3& light) {
    const auto channel = [](float value) {
        return QLocale().toString(static_cast<double>(value), 'f', 3);
    };
    return QStringLiteral("%1  %2  %3").arg(channel(light.x), channel(light.y), channel(light.z));
}

QString rayHelp(const Document& document, const RayNode& node, const glm::vec3& subtotal) {
    QStringList lines;
    lines << trRay("From %1 m").arg(rayPlace(node.origin));
    lines << trRay("Direction %1").arg(rayPlace(node.direction));
    if (node.hit) {
        const Material* material = document.material(node.material);
        lines << trRay("Meets %1 at %2 m")
                     .arg(rayMeshName(document, node.mesh), rayPlace(node.position));
        lines << trRay("Normal %1").arg(rayPlace(node.normal));
        if (material != nullptr)
            lines << trRay("Material %1").arg(toQString(material->name));
    }
    if (node.etaRatio > 0.0f) {
        const float incident = glm::degrees(std::acos(std::min(node.cosIncident, 1.0f)));
        const float sine =
            node.etaRatio * std::sqrt(std::max(1.0f - node.cosIncident * node.cosIncident, 0.0f));
        lines << (node.totalReflection
                      ? trRay("Snell: %1° · index ratio %2: total reflection")
                            .arg(rayNumber(incident), rayNumber(node.etaRatio))
                      : trRay("Snell: %1° goes on at %2° (index ratio %3)")
                            .arg(rayNumber(incident), rayNumber(glm::degrees(std::asin(sine))),
                                 rayNumber(node.etaRatio)));
    }
    const RayTerms& terms = node.terms;
    if (node.kind == RayKind::Reflected)
        lines << trRay("kr = %1").arg(lightText(terms.factor));
    if (node.kind == RayKind::Refracted)
        lines << trRay("kt = %1").arg(lightText(terms.factor));
    if (node.kind == RayKind::Shadow && terms.arriving != glm::vec3(0.0f)) {
        lines << trRay("f_att Ip = %1").arg(lightText(terms.arriving));
        lines << trRay("kd (N·L) = %1").arg(lightText(terms.diffuse));
        lines << trRay("ks (R·V)ⁿ = %1").arg(lightText(terms.specular));
    }
    if (node.kind != RayKind::Shadow && node.hit) {
        lines << trRay("Ia ka = %1 × %2")
                     .arg(lightText(terms.ambientLight), lightText(terms.ambient));
        if (terms.emission != glm::vec3(0.0f))
            lines << trRay("Emission %1").arg(lightText(terms.emission));
    }
    lines << trRay("Weight %1").arg(lightText(node.weight));
    if (node.kind == RayKind::Shadow && node.end == RayEnd::Lit)
        lines << trRay("S = %1 comes through").arg(lightText(node.passes));
    lines << trRay("Adds %1 to its camera ray").arg(lightText(node.contribution));
    lines << trRay("With all below, adds %1 to the pixel").arg(lightText(subtotal));
    lines << toQString(std::string(rayEndInfo(node.end).text));
    return lines.join(QLatin1Char('\n'));
}

} // namespace patina::editor
