// SPDX-License-Identifier: MIT
#include "compare/files/layers.h"

#include "compare/files/diptych_files.h"
#include "compare/files/layer_kinds.h"
#include "shared/text/did_you_mean.h"
#include "shared/text/fail.h"
#include "shared/text/one_line.h"
#include "shared/text/wildcard.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <utility>

namespace diptych {
namespace {

using Names = std::vector<std::string>;

// Selected components of an image.
Image picked(const Image& image, const std::vector<std::size_t>& components) {
    Image result(image.width, image.height, static_cast<int>(components.size()));
    for (std::size_t i = 0; i < image.pixels(); ++i)
        for (std::size_t c = 0; c < components.size(); ++c)
            result.pixel(i)[c] = image.pixel(i)[components[c]];
    return result;
}

Image8 picked(const Image8& coded, const std::vector<std::size_t>& components) {
    const std::size_t pixels = static_cast<std::size_t>(coded.width) * static_cast<std::size_t>(coded.height),
                      stored = static_cast<std::size_t>(coded.components);
    Image8 result{coded.width, coded.height, static_cast<int>(components.size()),
                  std::vector<std::uint8_t>(pixels * components.size())};
    for (std::size_t i = 0; i < pixels; ++i)
        for (std::size_t c = 0; c < components.size(); ++c)
            result.data[i * components.size() + c] = coded.data[i * stored + components[c]];
    return result;
}

// Converts colours from the layer's primaries. Other channels, such as normals written as R, G, B, do not
// change.
void convert(ImageChannel& channel, const ImageLayer& layer) {
    if (layer.to_rec709 && channel.kind == ChannelKind::color && channel.image.components == 3)
        convertColors(channel.image, *layer.to_rec709);
}

// Splits a layer into channels with one meaning each.
class Splitter {
public:
    Splitter(ImageLayer layer, std::vector<ImageChannel>& out) : layer_(std::move(layer)), out_(out) {
        left_.assign(layer_.channels.size(), true);
    }

    void split() {
        take({"R", "G", "B"}, layer_.name.empty() ? "lit" : layer_.name);
        take({"X", "Y", "Z"}, layer_.name.empty() ? "xyz" : layer_.name);
        take({"X", "Y"}, layer_.name.empty() ? "xy" : layer_.name);
        take({"U", "V"}, layer_.name.empty() ? "uv" : layer_.name);
        if (layer_.name.empty()) takeGrey();
        const bool alone = layer_.channels.size() == 1;
        for (std::size_t i = 0; i < left_.size(); ++i)
            if (left_[i]) put({i}, nameAlone(layer_.channels[i], alone));
    }

private:
    ImageLayer layer_;
    std::vector<ImageChannel>& out_;
    std::vector<bool> left_;

    // Grey Y becomes R, G, B, so that it can be compared with colours and by FLIP. Integers are no light.
    void takeGrey() {
        if (layer_.sample == "uint") return;
        for (std::size_t i = 0; i < layer_.channels.size(); ++i)
            if (left_[i] && layer_.channels[i] == "Y") {
                ImageChannel channel{"lit", {"Y"}, layer_.sample, ChannelKind::color, {}};
                if (layer_.image.empty())
                    channel.coded = coded({i});
                else
                    channel.image = picked(layer_.image, {i, i, i});
                left_[i] = false;
                out_.push_back(std::move(channel));
            }
    }

    bool isWhole(const std::vector<std::size_t>& components) const {
        return components.size() == layer_.channels.size() && std::ranges::is_sorted(components);
    }
    Image8 coded(const std::vector<std::size_t>& components) {
        return isWhole(components) ? std::move(layer_.coded) : picked(layer_.coded, components);
    }

    std::string nameAlone(const std::string& channel, bool alone) const {
        if (channel == "Z") return "depth";
        // "roughness.Y" is all of roughness.
        if (alone && !layer_.name.empty()) return layer_.name;
        if (componentOf(channel) != "A") return channel;
        return layer_.name.empty() ? "A" : layer_.name + ".A";
    }

    void take(const Names& suffixes, const std::string& name) {
        std::vector<std::size_t> components;
        for (const std::string& wanted : suffixes)
            for (std::size_t i = 0; i < layer_.channels.size(); ++i)
                if (left_[i] && componentOf(layer_.channels[i]) == wanted) {
                    components.push_back(i);
                    break;
                }
        if (components.size() == suffixes.size()) put(components, name);
    }

    void put(const std::vector<std::size_t>& components, const std::string& name) {
        ImageChannel channel{name, {}, layer_.sample, {}, {}};
        for (const std::size_t i : components) {
            channel.channels.push_back(layer_.channels[i]);
            left_[i] = false;
        }
        channel.kind = kindOf(name, channel.channels, channel.type);
        if (components.size() == 1 && components[0] < layer_.exact.size())
            channel.exact = std::move(layer_.exact[components[0]]);
        if (layer_.image.empty())
            channel.coded = coded(components);
        else
            channel.image = isWhole(components) ? std::move(layer_.image) : picked(layer_.image, components);
        convert(channel, layer_);
        out_.push_back(std::move(channel));
    }
};

// "albedo=diffuse.R,diffuse.G,diffuse.B".
struct Renaming {
    std::string name;
    Names channels;
};

Renaming renamingOf(const std::string& text) {
    Renaming renaming;
    const std::size_t equals = text.find('=');
    std::istringstream list(equals == text.npos ? "" : text.substr(equals + 1));
    for (std::string channel; std::getline(list, channel, ',');) renaming.channels.push_back(channel);
    if (equals == 0 || renaming.channels.empty() || std::ranges::count(renaming.channels, "") > 0)
        fail(fmt::format("--map {}: give NAME=CHANNEL,CHANNEL,..., e.g. albedo=diffuse.R,diffuse.G,diffuse.B",
                         text));
    renaming.name = text.substr(0, equals);
    return renaming;
}

std::string alphaOf(const std::string& color) {
    return color == "lit" ? "A" : color + ".A";
}

// If the renaming names a whole colour layer, as in "lit=ViewLayer.Combined": renamings of its colour and
// alpha.
std::vector<Renaming> spelledOut(const ImageFile& file, const Renaming& renaming) {
    for (const ImageLayer& layer : file.layers) {
        if (renaming.channels != Names{layer.name}) continue;
        std::vector<Renaming> all{{renaming.name, {}}};
        for (const char* wanted : {"R", "G", "B", "A"}) {
            const auto found = std::ranges::find(layer.channels, wanted, componentOf);
            if (found == layer.channels.end()) continue;
            if (*wanted == 'A')
                all.push_back({alphaOf(renaming.name), {*found}});
            else
                all[0].channels.push_back(*found);
        }
        if (all[0].channels.size() == 3) return all;
    }
    return {renaming};
}

// Channels of a renaming as one channel; empty unless the file has all of them.
std::optional<ImageChannel> renamed(ImageFile& file, const Renaming& renaming) {
    struct Source {
        ImageLayer* layer;
        std::size_t component;
    };
    std::vector<Source> sources;
    for (const std::string& wanted : renaming.channels)
        for (ImageLayer& layer : file.layers)
            if (const auto found = std::ranges::find(layer.channels, wanted); found != layer.channels.end()) {
                sources.push_back({&layer, static_cast<std::size_t>(found - layer.channels.begin())});
                break;
            }
    if (sources.size() != renaming.channels.size()) return {};
    ImageChannel channel{renaming.name, renaming.channels, sources[0].layer->sample, {}, {}};
    channel.kind = kindOf(channel.name, channel.channels, channel.type);
    channel.image = Image(file.width, file.height, static_cast<int>(sources.size()));
    for (std::size_t c = 0; c < sources.size(); ++c) {
        const Image& from = sources[c].layer->image;
        for (std::size_t i = 0; i < from.pixels(); ++i)
            channel.image.pixel(i)[c] = from.pixel(i)[sources[c].component];
    }
    convert(channel, *sources[0].layer);
    return channel;
}

void remove(ImageFile& file, const Names& channels) {
    for (ImageLayer& layer : file.layers) {
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < layer.channels.size(); ++i)
            if (std::ranges::count(channels, layer.channels[i]) == 0) kept.push_back(i);
        if (kept.size() == layer.channels.size()) continue;
        layer.image = picked(layer.image, kept);
        Names names;
        for (const std::size_t i : kept) names.push_back(layer.channels[i]);
        layer.channels = std::move(names);
    }
    std::erase_if(file.layers, [](const ImageLayer& layer) { return layer.channels.empty(); });
}

std::string list(const std::vector<ImageChannel>& channels) {
    Names names;
    for (const ImageChannel& channel : channels) names.push_back(channel.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

// Moves distinct integers that round to the same float32 to neighbouring floats. The difference then
// shows, though not its exact size.
void keepDistinct(const ImageChannel& a, ImageChannel& b) {
    if (a.exact.empty() && b.exact.empty()) return;
    const auto valueAt = [](const ImageChannel& c, std::size_t i) {
        return c.exact.empty() ? double{c.image.data[i]} : static_cast<double>(c.exact[i]);
    };
    for (std::size_t i = 0; i < a.image.pixels(); ++i)
        if (a.image.data[i] == b.image.data[i] && valueAt(a, i) != valueAt(b, i))
            b.image.data[i] = std::nextafter(b.image.data[i], 0.0f);
}

// A colour without alpha is opaque (PNG, third edition, 12.8; OpenEXR: a missing A reads as 1). If only
// `has` has a colour's alpha, adds an alpha of 1 to `lacks`. Returns the names of added channels.
Names addOpaque(const std::vector<ImageChannel>& has, std::vector<ImageChannel>& lacks) {
    const auto find = [](const std::vector<ImageChannel>& channels, const std::string& name) {
        return std::ranges::find(channels, name, &ImageChannel::name);
    };
    Names added;
    for (const ImageChannel& alpha : has) {
        if (componentOf(alpha.name) != "A" || find(lacks, alpha.name) != lacks.end()) continue;
        const std::string color = alpha.name == "A" ? "lit" : alpha.name.substr(0, alpha.name.size() - 2);
        if (find(has, color) == has.end() || find(lacks, color) == lacks.end()) continue;
        ImageChannel opaque{alpha.name, alpha.channels, alpha.type, alpha.kind, {}};
        if (alpha.image.empty())
            opaque.coded = {alpha.coded.width, alpha.coded.height, 1,
                            std::vector<std::uint8_t>(alpha.coded.data.size(), 255)};
        else
            opaque.image = Image(alpha.image.width, alpha.image.height, 1);
        std::ranges::fill(opaque.image.data, 1.0f);
        lacks.push_back(std::move(opaque));
        added.push_back(alpha.name);
    }
    return added;
}

// The only colours of two images with different colour names. Null if either image has not exactly one, or
// if both names are debug modes.
std::pair<ImageChannel*, ImageChannel*> onlyColours(std::vector<ImageChannel>& a,
                                                    std::vector<ImageChannel>& b) {
    const auto only = [](std::vector<ImageChannel>& channels) -> ImageChannel* {
        const auto isColour = [](const ImageChannel& c) { return c.kind == ChannelKind::color; };
        if (std::ranges::count_if(channels, isColour) != 1) return nullptr;
        return &*std::ranges::find_if(channels, isColour);
    };
    ImageChannel *const first = only(a), *const second = only(b);
    if (!first || !second || first->name == second->name ||
        (findDebugMode(first->name) && findDebugMode(second->name)))
        return {};
    return {first, second};
}

// Renames the test's only colour, and its alpha, like the reference's. Returns a note, or an empty string.
std::string pairColours(std::vector<ImageChannel>& reference, std::vector<ImageChannel>& test) {
    const auto [a, b] = onlyColours(reference, test);
    if (!a) return {};
    const std::string
        note = fmt::format(
            "{} of the reference is compared with {} of the test: each is the only colour of its image",
            a->name, oneLine(b->name, 60)),
        alpha = alphaOf(b->name);
    for (ImageChannel& channel : test)
        if (channel.name == alpha) channel.name = alphaOf(a->name);
    b->name = a->name;
    return note;
}

// A --map option that gives two channels of equal width one name.
std::string mapText(const std::vector<ImageChannel>& reference, const std::vector<ImageChannel>& test) {
    for (const ImageChannel& a : reference)
        for (const ImageChannel& b : test)
            if (a.components() == b.components() && a.channels.size() == b.channels.size())
                return fmt::format("--map '{}={}' compares these two", oneLine(a.name, 60),
                                   oneLine(fmt::format("{}", fmt::join(b.channels, ",")), 200));
    return "--map can match them";
}

// Sets the kind of a's three components if either image shows that they are no light. Returns a note on R, G,
// B that are taken as something else, or an empty string.
std::string setKind(ImageChannel& a, const ImageChannel& b) {
    if (a.components() != 3) return {};
    a.kind = std::max(a.kind, b.kind);
    const bool negative = a.kind == ChannelKind::color && (isNegative(a.image) || isNegative(b.image));
    if (negative) a.kind = ChannelKind::vector;
    const bool integers = a.type == "uint" || b.type == "uint" || (isWhole(a.image) && isWhole(b.image));
    if (integers) a.kind = ChannelKind::id;
    if (a.kind == ChannelKind::color ||
        (!integers && (componentOf(a.channels[0]) != "R" || (isDebugMode(a.name, 3) && !negative))))
        return {};
    return fmt::format("{}: not light, by its {}; {} are compared", a.name,
                       negative   ? "negative values"
                       : integers ? "integers"
                                  : "name",
                       a.kind == ChannelKind::id ? "exact values" : "vectors");
}

}  // namespace

std::vector<ImageChannel> channelsOf(ImageFile file, const std::vector<std::string>& names) {
    std::vector<ImageChannel> channels;
    Names used;
    for (const std::string& text : names) {
        for (const Renaming& renaming : spelledOut(file, renamingOf(text)))
            if (auto channel = renamed(file, renaming)) {
                used.insert(used.end(), renaming.channels.begin(), renaming.channels.end());
                channels.push_back(std::move(*channel));
            }
    }
    remove(file, used);
    takeUncertainty(file);
    for (ImageLayer& layer : file.layers) Splitter(std::move(layer), channels).split();
    return channels;
}

Image takeUncertainty(ImageFile& file) {
    const auto software = file.attributes.find("software");
    if (software == file.attributes.end() || software->second != softwareName) return {};
    const auto layer = std::ranges::find_if(file.layers, [](const ImageLayer& l) {
        return l.channels == std::vector<std::string>{uncertainty_channel};
    });
    if (layer == file.layers.end()) return {};
    Image uncertainty = std::move(layer->image);
    file.layers.erase(layer);
    return uncertainty;
}

void checkNames(ImageFile& reference, ImageFile& test, const std::vector<std::string>& names) {
    const auto channelsIn = [](const ImageFile& file) {
        Names all;
        for (const ImageLayer& layer : file.layers)
            all.insert(all.end(), layer.channels.begin(), layer.channels.end());
        return oneLine(fmt::format("{}", fmt::join(all, ", ")));
    };
    for (const std::string& text : names) {
        const Renaming renaming = renamingOf(text);
        if (!renamed(reference, spelledOut(reference, renaming)[0]) &&
            !renamed(test, spelledOut(test, renaming)[0]))
            fail(fmt::format(
                "--map {}: neither file has these channels; the reference has {}, the test has {}", text,
                channelsIn(reference), channelsIn(test)));
    }
}

MatchedChannels matchChannels(std::vector<ImageChannel> reference, std::vector<ImageChannel> test,
                              const std::vector<std::string>& wanted) {
    MatchedChannels matched;
    const auto isWanted = [&](const std::string& name) {
        return wanted.empty() || std::ranges::any_of(wanted, [&](const auto& w) { return matches(w, name); });
    };
    const std::string inReference = list(reference), inTest = list(test);
    if (std::string note = pairColours(reference, test); !note.empty())
        matched.notes.push_back(std::move(note));
    for (const bool lacking : {false, true})
        for (const std::string& name : lacking ? addOpaque(reference, test) : addOpaque(test, reference))
            matched.notes.push_back(fmt::format("{}: {} has none, so it counts as opaque: 1 everywhere", name,
                                                lacking ? "the test" : "the reference"));
    std::vector<std::string> inBoth;
    for (const ImageChannel& a : reference)
        if (std::ranges::count(test, a.name, &ImageChannel::name) > 0) inBoth.push_back(a.name);
    for (ImageChannel& a : reference) {
        if (!isWanted(a.name)) continue;
        const auto b = std::ranges::find(test, a.name, &ImageChannel::name);
        if (b == test.end()) {
            matched.one_sided.push_back({a.name, "the reference"});
            continue;
        }
        if (a.components() != b->components())
            fail(fmt::format("{}: {} in the reference and {} in the test; match them with --map", a.name,
                             fmt::join(a.channels, ","), fmt::join(b->channels, ",")));
        const bool grey[2] = {a.channels == Names{"Y"}, b->channels == Names{"Y"}};
        if (grey[0] != grey[1] && a.components() == 3)
            matched.notes.push_back(
                fmt::format("{}: the single component of {} is compared with all three of {}", a.name,
                            grey[0] ? "the reference" : "the test", grey[0] ? "the test" : "the reference"));
        if (a.type != b->type)
            matched.notes.push_back(
                fmt::format("{}: {} in the reference, {} in the test", a.name, a.type, b->type));
        keepDistinct(a, *b);
        if (std::string note = setKind(a, *b); !note.empty()) matched.notes.push_back(std::move(note));
        const ErrorKind errorKind = errorKindOf(a.name, a.channels.size(), a.kind);
        const auto stored = [](ImageChannel& c) {
            return StoredImage{std::move(c.image), std::move(c.coded), c.components()};
        };
        matched.channels.push_back(
            {a.name, a.kind, errorKind, a.type, b->type, a.channels, stored(a), stored(*b)});
    }
    for (const ImageChannel& b : test)
        if (isWanted(b.name) && std::ranges::find(reference, b.name, &ImageChannel::name) == reference.end())
            matched.one_sided.push_back({b.name, "the test"});
    const auto both = inReference == inTest
                          ? "both have " + inTest
                          : fmt::format("the reference has {}, the test has {}", inReference, inTest);
    for (const std::string& w : wanted)
        if (std::ranges::none_of(inBoth, [&](const std::string& name) { return matches(w, name); })) {
            const std::string meant = didYouMean(w, inBoth);
            fail(fmt::format("--channels {}: not in both images{}", w, meant.empty() ? "; " + both : meant));
        }
    if (matched.channels.empty())
        fail(fmt::format("the images share no layer: {}; {}", both, mapText(reference, test)));
    return matched;
}

}  // namespace diptych
