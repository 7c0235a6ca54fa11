// Two bodies of one composite each: the corner of the upper one is `gap` above the flat side y = 0 of the lower one, at x.
DefineConstant[ gap = 1e-3, x = 7.5e-3 ];
Point(1) = {0, 0, 0};
Point(2) = {0.016, -0.025, 0};
Point(3) = {0.03, 0, 0};
Point(4) = {x, gap, 0};
Point(5) = {x + 0.013, gap + 0.020, 0};
Point(6) = {x - 0.011, gap + 0.019, 0};
For i In {0:1}
  Line(3*i + 1) = {3*i + 1, 3*i + 2};
  Line(3*i + 2) = {3*i + 2, 3*i + 3};
  Line(3*i + 3) = {3*i + 3, 3*i + 1};
  Curve Loop(i + 1) = {3*i + 1, 3*i + 2, 3*i + 3};
  Plane Surface(i + 1) = {i + 1};
EndFor
Transfinite Curve{1:6} = 2;
Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
