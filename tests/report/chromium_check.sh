#!/bin/sh
# chromium_check.sh REPORT.html...
# Opens each report in headless Chromium, shows every recording, prepares it for paper, and fails on any script error.
# CHROMIUM names the browser (default: chromium).
set -eu
if [ $# -eq 0 ]; then
  echo "usage: $0 REPORT.html..." >&2
  exit 2
fi
chromium=${CHROMIUM:-chromium}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
for report in "$@"; do
  # The page under test is a copy with one more script, which does what a reader would do.
  sed 's|</body>||; s|</html>||' "$report" > "$work/page.html"
  cat >> "$work/page.html" <<'SCRIPT'
<script>
(function () {
  var root = document.documentElement;
  var api = window.hysteronReport;
  var n = (api.report.recordings || []).length;
  for (var i = 0; i < n; ++i) api.select(i);
  document.querySelectorAll("select").forEach(function (s) {
    for (var k = 0; k < s.options.length; ++k) { s.selectedIndex = k; s.dispatchEvent(new Event("change")); }
  });
  document.querySelectorAll("thead button").forEach(function (b) { b.click(); b.click(); });
  window.dispatchEvent(new Event("beforeprint"));
  root.dataset.printed = document.querySelectorAll(".print-only svg").length;
  window.dispatchEvent(new Event("afterprint"));
  root.dataset.canvases = document.querySelectorAll(".plot canvas").length;
  root.dataset.minis = document.querySelectorAll(".mini svg").length;
  root.dataset.recordings = n;
  root.dataset.scripts = document.scripts.length;
  // Drag over a plot zooms it, a double click brings everything back; the plots answer after the event.
  var figures = document.querySelectorAll("figure.plot.wide, figure.plot");
  function fire(target, type, x, y) {
    var box = target.getBoundingClientRect();
    target.dispatchEvent(new MouseEvent(type, { bubbles: true, movementX: 1, movementY: 1, clientX: box.left + x * box.width, clientY: box.top + y * box.height, button: 0 }));
  }
  function drag(figure) {
    var over = figure.querySelector(".u-over");
    fire(over, "mouseenter", 0.3, 0.3);
    fire(over, "mousemove", 0.3, 0.3);
    fire(over, "mousedown", 0.3, 0.3);
    fire(over, "mousemove", 0.6, 0.6);
    fire(over, "mouseup", 0.6, 0.6);
  }
  function zoomed() {
    return Array.prototype.filter.call(document.querySelectorAll("figure.plot .reset"), function (b) { return !b.hidden; }).length;
  }
  var plots = Array.prototype.filter.call(figures, function (f) { return f.querySelector(".u-over"); });
  window.scrollTo(0, 0);
  setTimeout(function () {
    plots.forEach(drag);
    setTimeout(function () {
      root.dataset.zoomed = zoomed();
      plots.forEach(function (f) { fire(f.querySelector(".u-over"), "dblclick", 0.5, 0.5); });
      setTimeout(function () {
        root.dataset.stillzoomed = zoomed();
        root.dataset.walked = "true";
      }, 200);
    }, 200);
  }, 200);
})();
</script></body></html>
SCRIPT
  "$chromium" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --user-data-dir="$work/profile" --window-size=1280,900 \
    --virtual-time-budget=8000 --dump-dom "file://$work/page.html" > "$work/dom.html" 2> "$work/log" || {
    echo "$report: $chromium failed" >&2
    tail -5 "$work/log" >&2
    failed=1
    continue
  }
  tag=$(grep -o '<html[^>]*>' "$work/dom.html" | head -n 1)
  value() { printf '%s' "$tag" | sed -n "s/.*data-$1=\"\([^\"]*\)\".*/\1/p"; }
  expect() {
    if [ "$(value "$1")" != "$2" ]; then
      echo "$report: $3: data-$1 is '$(value "$1")', expected '$2'; last error: $(value last-error)" >&2
      failed=1
    fi
  }
  expect ready true "the page's script did not finish"
  expect walked true "walking through the page failed"
  expect errors 0 "script errors"
  expect scripts 5 "the data made a script element"
  expect minis "$(value recordings)" "overview"
  if [ "$(value recordings)" != 0 ]; then
    expect canvases 4 "plots of the selected recording"
    expect printed 4 "plots for paper"
    expect zoomed 4 "drag to zoom"
    expect stillzoomed 0 "double click to reset"
  fi
done
[ "$failed" -eq 0 ] && echo "ok: $# page(s) without script errors"
exit "$failed"
