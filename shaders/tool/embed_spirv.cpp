// SPDX-License-Identifier: MIT
// Build tool: embed_spirv OUT.cpp LAYOUT.cpp FILE.spv...
// Writes every module as a row of shaderModules() (shared/vulkan/spirv.h), and, from the reflection of the
// modules, static_asserts that C++ lays out each struct of shared/contract as GLSL does.
#include "shaders/tool/spirv_words.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <sstream>
#include <tuple>

namespace {

enum Op : std::uint32_t {
    op_name = 5,
    op_member_name = 6,
    op_type_runtime_array = 29,
    op_decorate = 71,
    op_member_decorate = 72
};
enum Decoration : std::uint32_t { spec_id = 1, array_stride = 6, matrix_stride = 7, offset = 35 };

struct Member {
    std::string name;
    std::uint32_t offset = 0;
};

struct Reflection {
    std::map<std::uint32_t, std::string> names;
    std::map<std::uint32_t, std::map<std::uint32_t, Member>> members;  // by struct, by index
    std::map<std::uint32_t, std::uint32_t> strides, elements;          // by runtime array
    std::map<std::uint32_t, std::uint32_t> spec_ids;
};

Reflection reflect(const Words& w) {
    Reflection r;
    for (std::size_t i = 5; i < w.size(); i += w[i] >> 16) {
        const std::uint32_t op = w[i] & 0xffff, target = i + 1 < w.size() ? w[i + 1] : 0;
        const auto text = [&](std::size_t word) {
            return std::string(reinterpret_cast<const char*>(&w[word]));
        };
        if (op == op_name) r.names[target] = text(i + 2);
        if (op == op_member_name) r.members[target][w[i + 2]].name = text(i + 3);
        if (op == op_member_decorate && w[i + 3] == offset) r.members[target][w[i + 2]].offset = w[i + 4];
        if (op == op_type_runtime_array) r.elements[target] = w[i + 2];
        if (op == op_decorate && w[i + 2] == array_stride) r.strides[target] = w[i + 3];
        if (op == op_decorate && w[i + 2] == spec_id) r.spec_ids[target] = w[i + 3];
    }
    return r;
}

void writeModule(std::ofstream& out, const std::string& symbol, const Words& words) {
    out << "const std::uint32_t " << symbol << "[] = {";
    for (std::size_t i = 0; i < words.size(); ++i) out << (i % 16 == 0 ? "\n" : "") << words[i] << ",";
    out << "\n};\n";
}

int writeLayoutChecks(std::ofstream& out, const Reflection& r) {
    int structs = 0;
    for (const auto& [array, element] : r.elements) {
        if (!r.names.contains(element) || !r.members.contains(element) || !r.strides.contains(array))
            continue;
        const std::string type = r.names.at(element);
        for (const auto& [index, member] : r.members.at(element))
            out << "static_assert(offsetof(" << type << ", " << member.name << ") == " << member.offset
                << ");\n";
        out << "static_assert(sizeof(" << type << ") == " << r.strides.at(array) << ");\n";
        ++structs;
    }
    const std::string prefix = "feature_";
    for (const auto& [constant, id] : r.spec_ids)
        if (r.names.contains(constant) && r.names.at(constant).starts_with(prefix))
            out << "static_assert(FEATURE_" << r.names.at(constant).substr(prefix.size()) << " == " << id
                << ");\n";
    return structs;
}

// A module by its file's name without ".spv": SHADER.STAGE[.NUMBER][.area or .unlit]
// [.samples, .coverage or .half][.inputsN]. What is .half has the code of area lights, too.
struct Module {
    std::string name, shader;
    unsigned number = 0;
    bool area_lights = false, lights = true, samples = false, coverage = false, half = false;
    int inputs = 3;
    Words words;

    std::string symbol() const {
        std::string symbol = name;
        std::ranges::replace(symbol, '.', '_');
        return symbol;
    }
    auto order() const {
        return std::tie(shader, number, lights, area_lights, samples, coverage, half, inputs);
    }
};

Module moduleOf(const std::filesystem::path& file) {
    Module module;
    module.name = file.stem().string();
    module.words = readModule(file.string());
    std::istringstream parts(module.name);
    std::string stage, part;
    std::getline(parts, module.shader, '.');
    std::getline(parts, stage, '.');
    module.shader += "_" + stage;
    while (std::getline(parts, part, '.')) {
        if (part == "area")
            module.area_lights = true;
        else if (part == "unlit")
            module.lights = false;
        else if (part == "samples")
            module.samples = true;
        else if (part == "coverage")
            module.coverage = true;
        else if (part == "half")
            module.half = module.area_lights = true;
        else if (part.starts_with("inputs"))
            module.inputs = std::stoi(part.substr(std::string("inputs").size()));
        else
            module.number = static_cast<unsigned>(std::stoul(part));
    }
    return module;
}

void writeTable(std::ofstream& out, const std::vector<Module>& modules) {
    out << "}  // namespace\n\nnamespace diptych {\n\nstd::span<const ShaderModule> shaderModules() {\n"
           "    static constexpr ShaderModule modules[] = {\n";
    for (const Module& m : modules)
        out << "        {\"" << m.name << "\", Shader::" << m.shader << ", " << m.number << ", "
            << std::boolalpha << m.lights << ", " << m.area_lights << ", " << m.samples << ", " << m.coverage
            << ", " << m.half << ", " << m.inputs << ", " << m.symbol() << "},\n";
    out << "    };\n    return modules;\n}\n\n}  // namespace diptych\n";
}

void run(int argc, char** argv) {
    if (argc < 4) throw std::runtime_error("usage: embed_spirv OUT.cpp LAYOUT.cpp FILE.spv...");
    std::ofstream out(argv[1]), layout(argv[2]);
    out << "// Generated by embed_spirv.\n#include \"shared/vulkan/spirv.h\"\n\nnamespace {\n";
    layout << "// Generated by embed_spirv: C++ and GLSL agree on every struct and feature.\n#include "
              "<cstddef>\n";
    for (const char* header : {"culling", "debug_mode", "features", "geometry", "area_light", "light",
                               "light_list", "material", "object_lights", "view"})
        layout << "#include \"shared/contract/" << header << ".h\"\n";
    layout << "\nnamespace diptych::gpu {\n";
    std::vector<Module> modules;
    int structs = 0;
    for (int i = 3; i < argc; ++i) {
        modules.push_back(moduleOf(argv[i]));
        if (modules.back().name == "layout.comp")
            structs += writeLayoutChecks(layout, reflect(modules.back().words));
    }
    if (structs == 0) throw std::runtime_error("layout.comp: no struct to check");
    std::ranges::sort(modules, [](const Module& a, const Module& b) { return a.order() < b.order(); });
    for (const Module& module : modules) writeModule(out, module.symbol(), module.words);
    writeTable(out, modules);
    layout << "}  // namespace diptych::gpu\n";
    out.close();
    layout.close();
    if (!out || !layout) throw std::runtime_error("cannot write " + std::string(argv[1]));
}

}  // namespace

int main(int argc, char** argv) try {
    run(argc, argv);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "embed_spirv: %s\n", e.what());
    return 2;
}
