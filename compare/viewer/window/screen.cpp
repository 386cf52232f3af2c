// SPDX-License-Identifier: MIT
#include "compare/viewer/window/screen.h"

#include "compare/viewer/interface/fonts.h"
#include "compare/viewer/interface/interface.h"

#include <vulkan/vulkan_core.h>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <stdexcept>
#include <utility>

namespace diptych::viewer {
namespace {

constexpr int maxPresenters = 3;  // number of consecutive recreations after lost devices

void setScale(double scale) {
    ImGui::GetStyle() = ImGuiStyle();
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowRounding = 0;
    ImGui::GetStyle().WindowBorderSize = 0;
    ImGui::GetStyle().Colors[ImGuiCol_WindowBg] = {0.11f, 0.11f, 0.125f, 1};
    ImGui::GetStyle().ScaleAllSizes(static_cast<float>(scale));
    loadFonts(scale);
}

}  // namespace

Screen::ImGuiContextOf::ImGuiContextOf(GLFWwindow* window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui_ImplGlfw_InitForVulkan(window, false);
}

Screen::ImGuiContextOf::~ImGuiContextOf() {
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

Screen::Screen(const Window& window, bool validate, std::function<void(const std::string&)> report)
    : window_(window), report_(std::move(report)), imgui_(window.handle()), validate_(validate) {
    followScale();
}

void Screen::followScale() {
    const double scale = window_.contentScale();
    if (scale == scale_) return;
    scale_ = scale;
    setScale(scale);
    makePresenter();  // with fonts of that size
}

void Screen::makePresenter() {
    presenter_.reset();
    presenter_ = std::make_unique<Presenter>(window_.handle(), validate_ ? &log_ : nullptr);
    composed_ = {};
}

void Screen::draw(InterfaceState& state, const Contents& contents, const CanvasRect& canvas,
                  const std::vector<PanelRect>& panel_rects) {
    presenter_->beginFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    drawInterface(state, contents, canvas, panel_rects, scale_);
    ImGui::Render();
    compose(state, contents, canvas, panel_rects);
    if (presenter_->show(pixels_, ImGui::GetDrawData())) {
        presenters_ = 0;
        return;
    }
    if (++presenters_ > maxPresenters)
        throw std::runtime_error(
            "view: the device that shows the window was lost several times; try another --device");
    report_("the device that shows the window was lost and is started again");
    makePresenter();
}

void Screen::compose(const InterfaceState& state, const Contents& contents, const CanvasRect& canvas,
                     const std::vector<PanelRect>& panel_rects) {
    const Composed now{contents.shown, canvas, state.canvas,
                       state.view_options.difference != Difference::none};
    if (!now.shown || now == composed_) return;
    composed_ = now;
    pixels_.x = canvas.x;
    pixels_.y = canvas.y;
    pixels_.width = canvas.width;
    pixels_.height = canvas.height;
    pixels_.data = composed(*now.shown, canvas, panel_rects, presenter_->isBgr());
    ++pixels_.version;
}

}  // namespace diptych::viewer
