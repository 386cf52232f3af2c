// SPDX-License-Identifier: MIT
// Canonical form of disassembled SPIR-V: equal for modules that differ only in ids and in the order of
// declarations and blocks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace diptych {

// The lines of functions with their blocks in depth-first order from each function's first.
inline std::vector<std::string> blocksInOrder(const std::vector<std::string>& functions) {
    static const std::regex label("^%([0-9]+) = OpLabel$"), id("%([0-9]+)");
    std::map<std::string, std::vector<std::string>> blocks;
    std::vector<std::string> lines, *block = &lines;
    std::string first;
    const std::function<void(const std::string&)> visit = [&](const std::string& of) {
        const auto taken = blocks.extract(of);
        if (taken.empty()) return;
        lines.insert(lines.end(), taken.mapped().begin(), taken.mapped().end());
        for (const std::string& line : taken.mapped())  // branches and merges name blocks
            if (line.starts_with("Op"))
                for (std::sregex_iterator at(line.begin(), line.end(), id), end; at != end; ++at)
                    visit((*at)[1]);
    };
    for (const std::string& line : functions) {
        std::smatch match;
        if (std::regex_match(line, match, label)) {
            if (blocks.empty()) first = match[1];
            block = &blocks[match[1]];
        } else if (line == "OpFunctionEnd") {
            visit(first);
            block = &lines;
        }
        block->push_back(line);
    }
    return lines;
}

// `disassembly`: output of spirv-dis --no-header --raw-id. Each declaration (type, constant, variable with
// its decorations) becomes an index into `known`, a table shared by all compared modules. Ids in functions
// are renumbered in order of appearance. Returns the lines before the declarations, then those of the
// functions.
inline std::vector<std::string> canonicalSpirv(const std::string& disassembly,
                                               std::map<std::string, std::size_t>& known) {
    using Texts = std::map<std::string, std::string>;
    Texts declared, decorations;
    std::vector<std::string> before, functions;
    static const std::regex definition("^%([0-9]+) = (.*)$"),
        decoration("^(OpDecorate|OpMemberDecorate) %([0-9]+) (.*)$"), id("%([0-9]+)");
    std::istringstream stream(disassembly);
    std::map<std::string, std::vector<std::string>> decorated;
    bool inside = false;
    for (std::string line; std::getline(stream, line);) {
        line.erase(0, std::min(line.find_first_not_of(' '), line.size()));
        std::smatch match;
        inside |= line.find(" = OpFunction ") != std::string::npos;
        if (line.empty()) continue;
        if (inside)
            functions.push_back(line);
        else if (std::regex_match(line, match, decoration))
            decorated[match[2]].push_back(match[1].str() + " " + match[3].str());
        else if (std::regex_match(line, match, definition))
            declared[match[1]] = match[2];
        else
            before.push_back(line);
    }
    for (auto& [of, texts] : decorated) {
        std::ranges::sort(texts);
        for (const std::string& text : texts) decorations[of] += " | " + text;
    }
    const auto replaced = [](const std::string& line, const std::function<std::string(std::string)>& with) {
        std::string out;
        auto rest = line.cbegin();
        for (std::sregex_iterator at(line.begin(), line.end(), id), end; at != end; ++at) {
            out.append(rest, (*at)[0].first);
            out += with((*at)[1]);
            rest = (*at)[0].second;
        }
        return out.append(rest, line.cend());
    };
    Texts numbers;
    std::function<std::string(std::string)> numberOf = [&](const std::string& of) -> std::string {
        const auto found = numbers.find(of);
        if (found != numbers.end()) return found->second;
        const std::string text = replaced(declared.at(of), numberOf) + decorations[of];
        return numbers[of] = "#" + std::to_string(known.try_emplace(text, known.size()).first->second);
    };
    Texts locals;
    const auto name = [&](const std::string& of) {
        if (declared.contains(of)) return numberOf(of);
        return locals.try_emplace(of, "%" + std::to_string(locals.size())).first->second;
    };
    std::vector<std::string> lines;
    for (const std::string& line : before) {
        std::string text = replaced(line, name);
        if (text.starts_with("OpEntryPoint")) {  // lists its variables in any order
            std::istringstream parts(text);
            std::vector<std::string> words{std::istream_iterator<std::string>(parts), {}};
            std::ranges::sort(words);
            text.clear();
            for (const std::string& word : words) text += word + " ";
        }
        lines.push_back(text);
    }
    for (const std::string& line : blocksInOrder(functions)) {
        std::smatch match;
        const bool made = std::regex_match(line, match, definition);
        lines.push_back(replaced(line, name) + (made ? decorations[match[1]] : ""));
    }
    return lines;
}

}  // namespace diptych
