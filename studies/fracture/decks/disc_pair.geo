// Two discs of radius R, a gap apart along x; the right one is turned, so that a corner of one polygon meets no corner of the other.
DefineConstant[ R = 0.02, gap = 1e-4, n = 10, turn = 0.11 ];
lc = R/n;
For i In {0:1}
  cx = (2*i - 1)*(R + gap/2);
  p = newp;
  Point(p) = {cx, 0, 0, lc};
  For k In {0:3}
    Point(p + 1 + k) = {cx + R*Cos(i*turn + k*Pi/2), R*Sin(i*turn + k*Pi/2), 0, lc};
  EndFor
  c = newc;
  For k In {0:3}
    Circle(c + k) = {p + 1 + k, p, p + 1 + (k + 1)%4};
  EndFor
  l = newll;
  Curve Loop(l) = {c, c + 1, c + 2, c + 3};
  s = news;
  Plane Surface(s) = {l};
  If (i == 0)
    Physical Surface("left") = {s};
  Else
    Physical Surface("right") = {s};
  EndIf
EndFor
