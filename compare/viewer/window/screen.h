// SPDX-License-Identifier: MIT
// Draws the interface and the images in the window.
#pragma once

#include "compare/viewer/interface/interface_state.h"
#include "compare/viewer/window/presenter.h"
#include "compare/viewer/window/window.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace diptych::viewer {

class Screen {
public:
    // `report` receives a line if the window's device is lost. The window must outlive this.
    Screen(const Window& window, bool validate, std::function<void(const std::string&)> report);

    double scale() const { return scale_; }  // of texts
    void followScale();                      // of the window's monitor
    std::string device() const { return presenter_->device(); }
    const ValidationLog& log() const { return log_; }
    // Draws one frame. Throws std::runtime_error if the window's device is lost several times in a row.
    void draw(InterfaceState& state, const Contents& contents, const CanvasRect& canvas,
              const std::vector<PanelRect>& panel_rects);

private:
    // Dear ImGui's context and its event source.
    struct ImGuiContextOf {
        explicit ImGuiContextOf(GLFWwindow* window);
        ~ImGuiContextOf();
        ImGuiContextOf(const ImGuiContextOf&) = delete;
        ImGuiContextOf& operator=(const ImGuiContextOf&) = delete;
    };

    // Identifies the content of the window's pixels.
    struct Composed {
        std::shared_ptr<const DrawnView> shown;
        CanvasRect canvas;
        CanvasView view;
        bool difference = false;
        bool operator==(const Composed&) const = default;
    };

    void makePresenter();
    void compose(const InterfaceState& state, const Contents& contents, const CanvasRect& canvas,
                 const std::vector<PanelRect>& panel_rects);

    const Window& window_;
    const std::function<void(const std::string&)> report_;
    ImGuiContextOf imgui_;
    ValidationLog log_;
    const bool validate_;
    std::unique_ptr<Presenter> presenter_;
    int presenters_ = 0;  // consecutive losses
    double scale_ = 0;
    WindowPixels pixels_;
    Composed composed_;
};

}  // namespace diptych::viewer
