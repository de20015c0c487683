// Two teeth of a pinion and three of a wheel, module 4, 20 and 30 teeth, plane strain. Lengths in mm.
//   gmsh -2 gear_teeth.geo -o gear_teeth.msh
SetFactory("OpenCASCADE");
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
DefineConstant[ h = 0.35 ];
m = 4; alpha = 20*Pi/180;
inv = Tan(alpha) - alpha;
Macro Gear
  // centre (cx, 0), z teeth, the first tooth points along the angle a0; n teeth of it, from the angle of the first on; names: number s of the surface
  rb = m*z/2*Cos(alpha); ra = m*z/2 + m; rf = m*z/2 - 1.25*m; rh = rf - 2*m;
  half = Pi/(2*z) - 0.0012;    // half of a tooth at the pitch circle, less half of the backlash
  pts() = {};
  For k In {0:n-1}
    For side In {0:1}
      sg = 2*side - 1; pl() = {};
      For q In {0:8}
        j = (side == 0) ? q : 8 - q;
        rr = (rb > rf + 0.6 ? rb : rf + 0.6) + (ra - (rb > rf + 0.6 ? rb : rf + 0.6))*j/8;
        t = Acos(rb/rr); th = half + inv - (Tan(t) - t);
        an = a0 + k*2*Pi/z*dir + sg*dir*th;
        p = newp; Point(p) = {cx + rr*Cos(an), rr*Sin(an), 0}; pl() += {p};
      EndFor
      If (side == 0)
        an = a0 + (k*2*Pi/z - half*1.35)*dir; 
        p = newp; Point(p) = {cx + rf*Cos(an), rf*Sin(an), 0}; root0 = p;
        left() = pl();
      Else
        an = a0 + (k*2*Pi/z + half*1.35)*dir;
        p = newp; Point(p) = {cx + rf*Cos(an), rf*Sin(an), 0}; root1 = p;
        right() = pl();
      EndIf
    EndFor
    If (k == 0)
      an = a0 - 1.0*Pi/z*dir; p0 = newp; Point(p0) = {cx + rf*Cos(an), rf*Sin(an), 0}; 
      firstp = p0; lines() = {}; last = p0;
    EndIf
    cl = newc; Line(cl) = {last, root0}; lines() += {cl};
    cl = newc; Line(cl) = {root0, left(0)}; lines() += {cl};
    cl = newc; Spline(cl) = {left()}; lines() += {cl}; flanks() += {cl};
    cl = newc; Line(cl) = {left(8), right(0)}; lines() += {cl};
    cl = newc; Spline(cl) = {right()}; lines() += {cl}; flanks() += {cl};
    cl = newc; Line(cl) = {right(8), root1}; lines() += {cl};
    last = root1;
  EndFor
  an = a0 + ((n-1)*2 + 1)*Pi/z*dir; p1 = newp; Point(p1) = {cx + rf*Cos(an), rf*Sin(an), 0};
  cl = newc; Line(cl) = {last, p1}; lines() += {cl};
  p2 = newp; Point(p2) = {cx + rh*Cos(an), rh*Sin(an), 0};
  cl = newc; Line(cl) = {p1, p2}; lines() += {cl}; c1 = cl;
  an = a0 - 1.0*Pi/z*dir; p3 = newp; Point(p3) = {cx + rh*Cos(an), rh*Sin(an), 0};
  cl = newc; Line(cl) = {p2, p3}; lines() += {cl}; c2 = cl;
  cl = newc; Line(cl) = {p3, firstp}; lines() += {cl}; c3 = cl;
  Curve Loop(s) = {lines()}; Plane Surface(s) = {s};
Return
flanks() = {};
// pinion: centre at the origin; pitch circles touch at x = 40. A tooth of the pinion on the line of centres would stand in a gap of the wheel.
cx = 0; z = 20; n = 2; dir = 1; a0 = -2*Pi/z*0.5; s = 1;
Call Gear;
Physical Curve("hub of the pinion") = {c1, c2, c3};
fp() = flanks();
flanks() = {};
cx = 100; z = 30; n = 3; dir = -1; a0 = Pi + 2*Pi/z; s = 2;
Call Gear;
Physical Curve("hub of the wheel") = {c1, c2, c3};
Physical Curve("flanks of the pinion") = {fp()};
Physical Curve("flanks of the wheel") = {flanks()};
Physical Surface("pinion") = {1};
Physical Surface("wheel") = {2};
Field[1] = Distance; Field[1].CurvesList = {fp(), flanks()}; Field[1].NumPointsPerCurve = 100;
Field[2] = Threshold; Field[2].InField = 1; Field[2].SizeMin = h; Field[2].SizeMax = 5*h; Field[2].DistMin = 0.5; Field[2].DistMax = 6;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;
