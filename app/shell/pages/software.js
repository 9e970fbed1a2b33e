// A canvas drawn by software shares this page's thread: at half resolution the words of a held switch still get through.
export function drawnBySoftware() {
  const gl = document.createElement("canvas").getContext("webgl");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  return !gl || /swiftshader|llvmpipe|software/i.test(name);
}
