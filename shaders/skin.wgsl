// The skin pass: what is seen at each pixel, what it is made of, and what light leaves it. See `canvas::frame`.

struct Scene {
    // From positions to clip space; depth is 1 near and 0 far.
    clip: mat4x4f,
    eye: vec3f,
    light_count: u32,
    // Depth along the view's axis: dot(forward.xyz, position) + forward.w.
    forward: vec4f,
    // Linear, where there is no colour map.
    albedo: vec3f,
    bumpiness: f32,
    // Where there is no specular map.
    intensity: f32,
    roughness: f32,
    // k_spec.
    specular: f32,
    // R₀.
    reflectance: f32,
    // E times L_A: nine harmonics.
    irradiance: array<vec4f, 9>,
    // The inside of a cut, sRGB: rim, middle, bottom.
    tissue: array<vec4f, 3>,
}

@group(0) @binding(0) var<uniform> scene: Scene;
@group(1) @binding(2) var color_map: texture_2d<f32>;
@group(1) @binding(3) var normal_map: texture_2d<f32>;
@group(1) @binding(4) var occlusion_map: texture_2d<f32>;
@group(1) @binding(5) var specular_map: texture_2d<f32>;
@group(1) @binding(6) var discolor_map: texture_2d<f32>;

// What is switched off is not compiled.
override SHADOWS: bool;
override TRANSMITTANCE: bool;
override SPECULAR: bool;
override COLOR_MAP: bool;
override NORMAL_MAP: bool;
override OCCLUSION_MAP: bool;
override SPECULAR_MAP: bool;
override DISCOLORATION: bool;

// `Surface::Gutter`.
const GUTTER = 1u;

struct Corner {
    @location(0) position: vec3f,
    @location(1) uv: vec2f,
    @location(2) normal: vec3f,
    @location(3) tangent: vec3f,
    @location(4) bitangent: vec3f,
    @location(5) surface: u32,
}

struct Point {
    @builtin(position) clip: vec4f,
    @location(0) position: vec3f,
    @location(1) uv: vec2f,
    @location(2) normal: vec3f,
    @location(3) tangent: vec3f,
    @location(4) bitangent: vec3f,
    @location(5) @interpolate(flat) surface: u32,
}

@vertex
fn place(corner: Corner) -> Point {
    let clip = scene.clip * vec4f(corner.position, 1.0);
    return Point(
        clip, corner.position, corner.uv, corner.normal, corner.tangent, corner.bitangent, corner.surface,
    );
}

// What the surface is made of at a point.
struct Material {
    albedo: vec3f,
    // a.
    scattering: f32,
    // k_A.
    occlusion: f32,
    intensity: f32,
    roughness: f32,
    // n.
    normal: vec3f,
    // c and α.
    discolor: vec4f,
}

fn unit(v: vec3f, otherwise: vec3f) -> vec3f {
    let square = dot(v, v);
    return select(otherwise, v * inverseSqrt(square), square > 1e-30);
}

fn skin_at(point: Point, normal: vec3f) -> Material {
    var skin = Material(scene.albedo, 1.0, 1.0, scene.intensity, scene.roughness, normal, vec4f(0.0));
    if COLOR_MAP {
        let color = sample_srgb(color_map, point.uv);
        skin.albedo = color.rgb;
        skin.scattering = color.a;
    }
    if OCCLUSION_MAP {
        skin.occlusion = sample_plain(occlusion_map, point.uv).r;
    }
    if SPECULAR_MAP {
        let specular = sample_plain(specular_map, point.uv);
        skin.intensity = specular.r;
        skin.roughness = specular.g;
    }
    if NORMAL_MAP {
        let aside = sample_signed(normal_map, point.uv).xy;
        let height = sqrt(max(0.0, 1.0 - dot(aside, aside)));
        let bump = (aside.x * point.tangent + aside.y * point.bitangent) * scene.bumpiness;
        skin.normal = unit(bump + height * normal, normal);
    }
    if DISCOLORATION {
        skin.discolor = sample_plain(discolor_map, point.uv);
    }
    return skin;
}

// The inside of a cut, from its rim, v = 1, to its bottom.
fn tissue_at(point: Point, normal: vec3f) -> Material {
    let v = saturate(point.uv.y);
    let upper = mix(scene.tissue[1].rgb, scene.tissue[0].rgb, 2.0 * v - 1.0);
    let lower = mix(scene.tissue[2].rgb, scene.tissue[1].rgb, 2.0 * v);
    let color = select(lower, upper, v > 0.5);
    let albedo = vec3f(srgb_decode(color.r), srgb_decode(color.g), srgb_decode(color.b));
    return Material(albedo, 0.0, v, scene.intensity, scene.roughness, normal, vec4f(0.0));
}

// E(n), times L_A.
fn irradiated(n: vec3f) -> vec3f {
    let e = scene.irradiance;
    let sum = e[0] + e[1] * n.y + e[2] * n.z + e[3] * n.x + e[4] * (n.x * n.y) + e[5] * (n.y * n.z)
        + e[6] * (3.0 * n.z * n.z - 1.0) + e[7] * (n.x * n.z) + e[8] * (n.x * n.x - n.y * n.y);
    return max(sum.rgb, vec3f(0.0));
}

struct Leaving {
    diffuse: vec3f,
    specular: vec3f,
}

fn lit(light: Lamp, position: vec3f, normal: vec3f, view: vec3f, material: Material) -> Leaving {
    var leaving = Leaving(vec3f(0.0), vec3f(0.0));
    let to = light.position - position;
    let distance = length(to);
    let direction = to / distance;
    let arrives = light.color * arriving(light, distance, direction);
    if all(arrives == vec3f(0.0)) {
        return leaving;
    }
    let facing = dot(material.normal, direction);
    if facing > 0.0 {
        var light_there = arrives * facing;
        if SHADOWS {
            light_there *= shadowed(light, position, normal);
        }
        leaving.diffuse = material.albedo * light_there;
        if SPECULAR {
            let part = reflected(material.normal, view, direction, material.roughness, scene.reflectance);
            leaving.specular = light_there * (scene.specular * material.intensity * part);
        }
    }
    if TRANSMITTANCE {
        let wrapped = saturate(0.3 - dot(normal, direction));
        if wrapped > 0.0 {
            leaving.diffuse += material.albedo * arrives * transmitted(light, position, normal) * wrapped;
        }
    }
    return leaving;
}

struct Pixel {
    // a beside it.
    @location(0) diffuse: vec4f,
    @location(1) depth: f32,
    @location(2) specular: vec4f,
    @location(3) discolor: vec4f,
}

// The most that half a float holds.
const BRIGHTEST = vec3f(65504.0);

@fragment
fn shade(point: Point, @builtin(front_facing) front: bool) -> Pixel {
    let outward = unit(point.normal, vec3f(0.0, 1.0, 0.0));
    let normal = select(-outward, outward, front);
    let view = unit(scene.eye - point.position, vec3f(0.0));
    var material: Material;
    if point.surface == GUTTER {
        material = tissue_at(point, normal);
    } else {
        material = skin_at(point, normal);
    }
    var diffuse = material.albedo * (material.occlusion * irradiated(material.normal));
    var specular = vec3f(0.0);
    for (var i = 0u; i < scene.light_count; i++) {
        let leaving = lit(lights[i], point.position, normal, view, material);
        diffuse += leaving.diffuse;
        specular += leaving.specular;
    }
    let depth = dot(scene.forward.xyz, point.position) + scene.forward.w;
    return Pixel(
        vec4f(min(diffuse, BRIGHTEST), material.scattering),
        depth,
        vec4f(min(specular, BRIGHTEST), 0.0),
        material.discolor,
    );
}
