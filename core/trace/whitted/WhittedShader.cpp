#include "core/trace/whitted/WhittedShader.h"

#include "core/math/Sampling.h"
#include "core/trace/RayScene.h"
#include "core/trace/whitted/TeachingHierarchy.h"

#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace patina {
namespace {

// Shadow rays through glass end where next to nothing comes through, or after so many faces.
constexpr float kLeastPassing = 1e-4f;
constexpr int kMostFaces = 256;
constexpr float kNoEnd = std::numeric_limits<float>::infinity();
// Backs that a camera ray passes, as of paths.
constexpr int kMostBacksPassed = 256;
// Random numbers of a place: those of its rays on, then those of its lights.
enum Branch : std::uint32_t { kMirrorBranch = 1, kRefractedBranch, kGlossBranch, kFirstLight };

float largest(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

} // namespace

void RayCounts::add(const RayCounts& other) {
    rays += other.rays;
    depth = std::max(depth, other.depth);
    boxTests += other.boxTests;
    triangleTests += other.triangleTests;
}

// Shares of light that a place sends back along a ray, and where its rays on go.
struct WhittedShader::Optics {
    glm::vec3 ambient{0.0f};   // of light that is alike from everywhere
    glm::vec3 reflected{0.0f}; // of what comes from there; 0: no such ray
    glm::vec3 reflectedFrom{0.0f};
    glm::vec3 refracted{0.0f};
    glm::vec3 refractedFrom{0.0f};
    float cosIncident = 0.0f, etaRatio = 0.0f;
    bool total = false; // reflection: nothing is refracted
    [[nodiscard]] bool isDull() const {
        return reflected == glm::vec3(0.0f) && refracted == glm::vec3(0.0f);
    }
};

WhittedShader::WhittedShader(const TraceScene& scene, const WhittedLights& lights,
                             const TraceView& view, const WhittedSettings& settings,
                             const TeachingHierarchy* hierarchy)
    : m_scene(scene)
    , m_lights(lights)
    , m_view(view)
    , m_settings(settings)
    , m_hierarchy(hierarchy) {}

WhittedShader::Sample WhittedShader::look(const glm::vec3& origin, const glm::vec3& direction,
                                          std::uint32_t index, std::uint32_t seed, RayTree* tree) {
    m_tree = tree;
    m_index = index;
    m_sum = glm::dvec3(0.0);
    m_alpha = 1.0f;
    m_counts = {};
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    ray.fromCamera = true;
    ray.seed = seed;
    static_cast<void>(RayScene::takeChance()); // of other rays
    follow(ray);
    return {glm::vec3(m_sum), m_alpha, m_counts, RayScene::takeChance()};
}

// ---- Records: what the sample and the tree get --------------------------------------------------

int WhittedShader::begin(const Ray& ray) {
    m_counts.depth = std::max(m_counts.depth, static_cast<std::uint32_t>(ray.depth));
    if (m_tree == nullptr)
        return RayNode::kNone;
    RayNode node;
    node.kind = ray.kind;
    node.parent = ray.parent;
    node.depth = ray.depth;
    node.origin = m_scene.toWorld(ray.origin);
    node.direction = ray.direction;
    node.weight = ray.weight;
    node.terms.factor = ray.factor;
    node.distance = kNoEnd;
    return m_tree->add(node);
}

void WhittedShader::met(int node, const TracePoint& point, float distance) {
    if (m_tree == nullptr)
        return;
    RayNode& of = m_tree->at(node);
    of.hit = true;
    of.position = m_scene.toWorld(point.position);
    of.normal = point.normal;
    of.distance = m_scene.metres(distance);
    of.mesh = m_scene.meshId(point.mesh);
    of.material = m_scene.materialOf(point.mesh);
}

void WhittedShader::end(int node, RayEnd reason) {
    if (m_tree != nullptr)
        m_tree->at(node).end = reason;
}

void WhittedShader::add(int node, const glm::vec3& light) {
    m_sum += glm::dvec3(light);
    if (m_tree != nullptr)
        m_tree->at(node).contribution = light;
}

ClosestRay WhittedShader::closest(const glm::vec3& origin, const glm::vec3& direction,
                                  float distance, bool goesOn) {
    m_counts.rays += goesOn ? 0 : 1;
    ++m_rays;
    if (m_hierarchy != nullptr) {
        const TeachingHierarchy::Tests tests = m_hierarchy->count(origin, direction, distance);
        m_counts.boxTests += tests.boxes;
        m_counts.triangleTests += tests.triangles;
    }
    return m_scene.closest(origin, direction);
}

// ---- The recursion ------------------------------------------------------------------------------

void WhittedShader::follow(Ray ray) {
    const int node = begin(ray);
    ClosestRay hit = closest(ray.origin, ray.direction, kNoEnd);
    TracePoint point;
    for (int backs = 0;; ++backs) {
        if (hit.mesh == ClosestRay::kNothing || backs == kMostBacksPassed)
            return miss(ray, node);
        point = m_scene.pointAt(hit);
        if (point.hasSurface())
            break;
        if (ray.kind != RayKind::Camera) {
            met(node, point, glm::length(point.position - ray.origin));
            return end(node, RayEnd::Back);
        }
        hit = closest(TraceScene::origin(point, true), ray.direction, kNoEnd, true);
    }
    const float distance = glm::length(point.position - ray.origin);
    met(node, point, distance);
    absorb(ray, node, point, m_scene.metres(distance));
    Place place{point, m_scene.surface(point, -ray.direction), {}};
    if (point.material->transmits())
        place.surface = m_scene.surfaceIn(point, -ray.direction, ray.media);
    else
        place.surface.opaque = place.terms;
    const Optics optics = opticsOf(place, ray);
    const glm::vec3 emission = point.emission();
    if (m_tree != nullptr) {
        RayTerms& terms = m_tree->at(node).terms;
        terms.ambientLight = m_lights.ambient();
        terms.ambient = optics.ambient;
        terms.emission = emission;
    }
    add(node, ray.weight * (emission + optics.ambient * m_lights.ambient()));
    if (optics.isDull())
        end(node, emission == glm::vec3(0.0f) ? RayEnd::NotReflecting : RayEnd::Emissive);
    lightFrom(ray, node, place);
    branch(ray, node, place, optics);
}

// Beer and Lambert's law along the ray. A ray that leaves a body which it has not entered began in
// it.
void WhittedShader::absorb(Ray& ray, int node, const TracePoint& point, float metres) {
    const TraceMaterial& material = *point.material;
    if (point.isBack && material.transmits() && !material.glass().thinWalled &&
        !ray.media.contains(&material))
        ray.media.enter({&material, m_scene.indexOf(material)});
    ray.weight *= ray.media.transmittance(metres);
    if (m_tree != nullptr)
        m_tree->at(node).weight = ray.weight;
}

// Behind sheets of glass there is what is behind the scene, too.
void WhittedShader::miss(Ray& ray, int node) {
    end(node, RayEnd::Missed);
    ray.weight *= ray.media.transmittance(kNoEnd);
    if (m_tree != nullptr)
        m_tree->at(node).weight = ray.weight;
    if (ray.fromCamera && m_view.transparent) {
        const bool all = ray.weight == glm::vec3(1.0f);
        m_alpha = all ? 0.0f : std::max(m_alpha - shading::luminance(ray.weight), 0.0f);
        return;
    }
    add(node, ray.weight * (ray.fromCamera && m_view.background
                                ? m_view.background(ray.direction)
                                : m_scene.environmentRadiance(ray.direction)));
}

// ka, ks and kt. What is rough reflects and transmits the environment as if it were alike
// everywhere.
WhittedShader::Optics WhittedShader::opticsOf(const Place& place, const Ray& ray) const {
    const bool is1980 = m_settings.model == LocalModel::Whitted1980;
    const shading::SurfaceTerms& terms = place.terms;
    const shading::SurfaceTerms& opaque = place.surface.opaque;
    const float glass = place.surface.glassShare;
    Optics optics;
    optics.ambient = is1980 ? terms.diffuseColor : (1.0f - glass) * opaque.diffuseAlbedo;
    optics.reflectedFrom = glm::reflect(ray.direction, terms.n);
    if (terms.perceptualRoughness < kMirrorRoughness || m_settings.gloss) {
        optics.reflected = is1980 ? terms.f0 : (1.0f - glass) * opaque.specularAlbedo;
        if (glass > 0.0f)
            refract(optics, place, ray);
        else if (m_settings.gloss)
            optics.reflectedFrom = glossDirection(terms, ray.seed, optics.reflected);
        return optics;
    }
    if (is1980)
        return optics;
    optics.ambient += (1.0f - glass) * opaque.specularAlbedo;
    if (glass > 0.0f) {
        const GlassTerms& clear = place.surface.glass;
        const float reflects = glassReflectance(clear, clear.NoV);
        optics.ambient += glass * (reflects + (1.0f - reflects) * clear.tint);
    }
    return optics;
}

// Snell's and Fresnel's laws, of the share of the surface that is glass.
void WhittedShader::refract(Optics& optics, const Place& place, const Ray& ray) const {
    const GlassTerms& glass = place.surface.glass;
    const float share = place.surface.glassShare;
    const glm::vec3 n =
        m_settings.gloss && !glass.isSmooth() ? facetNormal(place.terms, ray.seed) : glass.n;
    const float cosine = glm::clamp(glm::dot(n, glass.v), 0.0f, 1.0f);
    const float ratio = glass.isStraight() ? 1.0f : 1.0f / glass.eta;
    const float sin2 = ratio * ratio * (1.0f - cosine * cosine); // behind
    optics.cosIncident = cosine;
    optics.etaRatio = ratio;
    optics.total = sin2 >= 1.0f && ratio > 1.0f;
    optics.reflectedFrom = glm::reflect(ray.direction, n);
    optics.refractedFrom =
        glass.isStraight()
            ? ray.direction
            : glm::normalize(ratio * ray.direction +
                             (ratio * cosine - std::sqrt(std::max(1.0f - sin2, 0.0f))) * n);
    if (m_settings.model == LocalModel::Whitted1980) {
        const glm::vec3 behind = (glm::vec3(1.0f) - place.terms.f0) * place.terms.clearColor;
        (optics.total ? optics.reflected : optics.refracted) += behind;
        return;
    }
    const float reflects = optics.total ? 1.0f : glassReflectance(glass, cosine);
    optics.reflected += glm::vec3(share * reflects);
    if (!optics.total)
        optics.refracted = share * (1.0f - reflects) * glass.tint;
}

// ---- Light of the lights ------------------------------------------------------------------------

glm::vec3 WhittedShader::local(const shading::SurfaceTerms& terms, const glm::vec3& l,
                               const glm::vec3& irradiance, RayTerms* told) const {
    if (m_settings.model == LocalModel::Patina) {
        const shading::ShadedLight lit = shading::shadeDirect(terms, l, irradiance);
        if (told != nullptr) {
            const auto share = [&](const glm::vec3& of) {
                glm::vec3 result(0.0f);
                for (int c = 0; c < 3; ++c)
                    result[c] = irradiance[c] > 0.0f ? of[c] / irradiance[c] : 0.0f;
                return result;
            };
            told->arriving = irradiance;
            told->diffuse = share(lit.diffuse);
            told->specular = share(lit.specular);
        }
        return lit.diffuse + lit.specular;
    }
    const float NoL = glm::dot(terms.n, l);
    if (NoL <= 0.0f)
        return glm::vec3(0.0f);
    // Blinn's exponent p = 2/α² - 2 has the peak of GGX (D_BlinnPhong_Sin2()), and Phong's, of the
    // angle between R and V, which is twice that of N and H, is a quarter of it: Fisher & Woo 1994,
    // "R.E versus N.H Specular Highlights", Graphics Gems IV.
    const float exponent = 0.5f * (1.0f / (terms.alpha * terms.alpha) - 1.0f);
    const float RoV = glm::dot(glm::reflect(-l, terms.n), terms.v);
    const float highlight = RoV > 0.0f ? std::pow(std::min(RoV, 1.0f), exponent) : 0.0f;
    // f_att Ip: what a white diffuse surface that faces the light sends back.
    if (told != nullptr) {
        told->arriving = shading::kInvPi * irradiance;
        told->diffuse = terms.diffuseColor * NoL;
        told->specular = terms.f0 * highlight;
    }
    return shading::kInvPi * irradiance * (terms.diffuseColor * NoL + terms.f0 * highlight);
}

PointLight WhittedShader::lightAt(std::size_t index, const glm::vec3& from,
                                  std::uint32_t seed) const {
    if (!m_settings.softShadows)
        return m_lights.centre(index, from);
    const std::uint32_t of = seedFor(seed, kFirstLight + static_cast<std::uint32_t>(index));
    const glm::vec2 point = sobolOwen2D(m_index, of);
    return m_lights.point(index, from, {point, sobolOwen2D(m_index, seedFor(of, 0)).x});
}

void WhittedShader::lightFrom(const Ray& ray, int node, const Place& place) {
    const glm::vec3 from = TraceScene::origin(place.point);
    for (std::size_t i = 0; i < m_lights.size(); ++i) {
        const PointLight light = lightAt(i, from, ray.seed);
        Ray to;
        to.kind = RayKind::Shadow;
        to.origin = from;
        to.direction = light.direction;
        to.weight = ray.weight;
        to.depth = ray.depth;
        to.parent = node;
        const int shadow = begin(to);
        if (m_tree != nullptr) {
            m_tree->at(shadow).light = light.light;
            m_tree->at(shadow).glowing = light.glowing;
        }
        const glm::vec3 lit = glm::dot(place.point.face, light.direction) > 0.0f
                                  ? local(place.terms, light.direction, light.irradiance,
                                          m_tree != nullptr ? &m_tree->at(shadow).terms : nullptr)
                                  : glm::vec3(0.0f);
        if (lit == glm::vec3(0.0f)) {
            end(shadow, RayEnd::Facing);
            continue;
        }
        if (!light.castsShadow)
            end(shadow, RayEnd::NoShadow);
        const glm::vec3 passes =
            light.castsShadow ? passesTo(from, light, shadow) : glm::vec3(1.0f);
        add(shadow, ray.weight * passes * lit);
    }
}

// S: what of the light comes through along the straight ray. Faces of clear bodies let through
// 1 - F at the ray's angle, in their colour, and the bodies what they do not absorb.
glm::vec3 WhittedShader::passesTo(const glm::vec3& from, const PointLight& light, int node) {
    glm::vec3 passes(1.0f), origin = from;
    float done = 0.0f; // of the ray's way
    for (int faces = 0;; ++faces) {
        const ClosestRay hit = closest(origin, light.direction, light.distance - done, faces > 0);
        if (hit.mesh == ClosestRay::kNothing || done + hit.ray.maxDistance >= light.distance)
            break;
        if (light.meetsItself && m_scene.meshId(hit.mesh) == light.glowing)
            break;
        const TracePoint point = m_scene.pointAt(hit);
        if (point.material->transmits())
            passes *= passesFace(point, light.direction, m_scene.metres(hit.ray.maxDistance));
        if (!point.material->transmits() || largest(passes) < kLeastPassing ||
            faces == kMostFaces) {
            met(node, point, done + hit.ray.maxDistance);
            end(node, RayEnd::Blocked);
            return glm::vec3(0.0f);
        }
        done += hit.ray.maxDistance;
        origin = TraceScene::origin(point, true);
    }
    if (m_tree != nullptr)
        m_tree->at(node).passes = passes;
    end(node, RayEnd::Lit);
    if (m_tree != nullptr && !std::isinf(light.distance)) {
        RayNode& of = m_tree->at(node);
        of.distance = m_scene.metres(light.distance);
        of.position = m_scene.toWorld(from + light.distance * light.direction);
    }
    return passes;
}

// `metres`: that the ray came to the face, within the body where it leaves it. Rays are not bent
// here: the angle within a body is that outside, and there is no total reflection.
glm::vec3 WhittedShader::passesFace(const TracePoint& point, const glm::vec3& direction,
                                    float metres) const {
    const TraceMaterial& material = *point.material;
    const shading::SurfaceInputs inputs = material.inputsAt(point.uv);
    GlassTerms face;
    face.thinWalled = material.glass().thinWalled;
    face.eta = glassEta(m_scene.indexOf(material), 1.0f);
    const float reflects =
        m_settings.model == LocalModel::Whitted1980
            ? shading::f0FromIor(m_scene.indexOf(material))
            : glassReflectance(face, std::abs(glm::dot(point.normal, direction)));
    glm::vec3 passes =
        (1.0f - reflects) * (1.0f - inputs.metallic) * inputs.transmission * inputs.baseColor;
    if (point.isBack && !face.thinWalled)
        passes *= glm::exp(-metres * material.glass().absorption);
    return passes;
}

// ---- Rays on ------------------------------------------------------------------------------------

void WhittedShader::branch(const Ray& ray, int node, const Place& place, const Optics& optics) {
    if (optics.isDull())
        return;
    if (m_tree != nullptr) {
        RayNode& of = m_tree->at(node);
        of.cosIncident = optics.cosIncident;
        of.etaRatio = optics.etaRatio;
        of.totalReflection = optics.total;
    }
    Ray child;
    child.depth = ray.depth + 1;
    child.parent = node;
    if (optics.reflected != glm::vec3(0.0f)) {
        child.kind = RayKind::Reflected;
        child.origin = TraceScene::origin(place.point);
        child.direction = optics.reflectedFrom;
        child.weight = ray.weight * optics.reflected;
        child.factor = optics.reflected;
        child.seed = seedFor(ray.seed, kMirrorBranch);
        child.media = ray.media;
        branchOff(child, glm::dot(place.point.face, child.direction) <= 0.0f);
    }
    if (optics.refracted != glm::vec3(0.0f)) {
        child.kind = RayKind::Refracted;
        child.origin = TraceScene::origin(place.point, true);
        child.direction = optics.refractedFrom;
        child.weight = ray.weight * optics.refracted;
        child.factor = optics.refracted;
        child.seed = seedFor(ray.seed, kRefractedBranch);
        child.media = ray.media;
        if (!place.surface.glass.thinWalled)
            child.media.cross(place.point, place.surface.ior);
        child.fromCamera = ray.fromCamera && place.surface.glass.isStraight();
        branchOff(child, glm::dot(place.point.face, child.direction) >= 0.0f);
    }
}

// A facet that the viewer sees, with the density of visible normals (of GGX).
glm::vec3 WhittedShader::facetNormal(const shading::SurfaceTerms& terms, std::uint32_t seed) const {
    glm::vec3 t, b;
    shading::orthonormalBasis(terms.n, t, b);
    const glm::vec3 h =
        shading::sampleHalfVector(terms.model, sobolOwen2D(m_index, seedFor(seed, kGlossBranch)),
                                  shading::viewerInFrame(terms, t, b), terms.alpha);
    return glm::normalize(h.x * t + h.y * b + h.z * terms.n);
}

// A direction of the specular lobe, and what the lobe reflects of light from there over how likely
// it was chosen.
glm::vec3 WhittedShader::glossDirection(const shading::SurfaceTerms& terms, std::uint32_t seed,
                                        glm::vec3& share) const {
    glm::vec3 t, b;
    shading::orthonormalBasis(terms.n, t, b);
    const glm::vec3 wo = shading::viewerInFrame(terms, t, b);
    const glm::vec3 h = shading::sampleHalfVector(
        terms.model, sobolOwen2D(m_index, seedFor(seed, kGlossBranch)), wo, terms.alpha);
    const glm::vec3 wi = glm::reflect(-wo, h);
    const glm::vec3 l = glm::normalize(wi.x * t + wi.y * b + wi.z * terms.n);
    share = glm::vec3(0.0f);
    if (wi.z <= 0.0f)
        return l;
    const float pdf =
        shading::specularReflectionPdf(terms.model, wo.z, h.z, h.x * h.x + h.y * h.y,
                                       glm::clamp(glm::dot(wo, h), 0.0f, 1.0f), terms.alpha);
    if (pdf > 0.0f)
        share = shading::shadeDirect(terms, l, glm::vec3(1.0f)).specular / pdf;
    return l;
}

void WhittedShader::branchOff(const Ray& child, bool below) {
    const auto cut = [&](RayEnd reason) {
        if (m_tree != nullptr)
            end(begin(child), reason);
    };
    if (below)
        return cut(RayEnd::Below);
    if (largest(child.weight) < m_settings.minContribution)
        return cut(RayEnd::Contribution);
    if (child.depth > m_settings.maxDepth)
        return cut(RayEnd::Depth);
    follow(child);
}

} // namespace patina
