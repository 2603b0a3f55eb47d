package @name@ "@title@"
  // Written by hysteron.

@damper@
  function exponential "Of what a number can hold"
    input Real a;
    output Real y;
  algorithm
    y := exp(min(max(a, -708.0), 709.0));
  end exponential;

  function logarithm "Of what is above 0"
    input Real a;
    output Real y;
  algorithm
    y := log(max(a, 1e-300));
  end logarithm;

  function power "a^n for a >= 0"
    input Real a;
    input Real n;
    output Real y;
  algorithm
    y := if a < 1e-300 then 0.0 else exp(min(max(n * log(a), -708.0), 709.0));
  end power;

  function power_law "a^n for a >= 0, exact where n is 1 or 2"
    input Real a;
    input Real n;
    output Real y;
  algorithm
    y := if n <= 1.0 and n >= 1.0 then a else if n <= 2.0 and n >= 2.0 then a * a else power(a, n);
  end power_law;

  function cubic "Through y0 and y1 with these slopes, at u from 0 to 1 of a span h"
    input Real u;
    input Real h;
    input Real y0;
    input Real y1;
    input Real slope0;
    input Real slope1;
    output Real y;
  algorithm
    y := ((h * (slope0 + slope1) - 2.0 * (y1 - y0)) * u + 3.0 * (y1 - y0) - h * (2.0 * slope0 + slope1)) * u * u + h * slope0 * u + y0;
  end cubic;

  function cubicSlope "Slope of cubic"
    input Real u;
    input Real h;
    input Real y0;
    input Real y1;
    input Real slope0;
    input Real slope1;
    output Real y;
  algorithm
    y := ((3.0 * (h * (slope0 + slope1) - 2.0 * (y1 - y0)) * u + 2.0 * (3.0 * (y1 - y0) - h * (2.0 * slope0 + slope1))) * u + h * slope0) / h;
  end cubicSlope;

@test@
  class Model "Holds the state of one damper"
    extends ExternalObject;

    function constructor
      input Real frequency(unit = "Hz");
      output Model model;
      external "C" model = @name@_external_new(frequency)
        annotation(Include = "#include \"@name@_modelica.h\"",
                   IncludeDirectory = "modelica://@name@/Resources/Include");
    end constructor;

    function destructor
      input Model model;
      external "C" @name@_external_delete(model)
        annotation(Include = "#include \"@name@_modelica.h\"",
                   IncludeDirectory = "modelica://@name@/Resources/Include");
    end destructor;
  end Model;

  impure function step "Force at a sample of the motion, which follows the last one"
    input Model model;
    input Real instant(unit = "s");
    input Real displacement(unit = "m");
    input Real velocity(unit = "m/s");
    input Real slope(unit = "m/s2") "of the velocity between samples";
    input Real acceleration(unit = "m/s2");
    input Real jerk(unit = "m/s3");
    input Real drive "@drive@";
    input Boolean derive "take slope, acceleration and jerk from the velocity";
    output Real force(unit = "N");
    external "C" force = @name@_external_force(model, instant, displacement, velocity, slope, acceleration, jerk, drive, derive)
      annotation(Include = "#include \"@name@_modelica.h\"",
                 IncludeDirectory = "modelica://@name@/Resources/Include");
  end step;

  block SampledDamper "Force in the steps of the C code, at every sample of the motion and held in between"
    parameter Real samplePeriod(unit = "s") = 1e-3;
    parameter Real frequency(unit = "Hz") = @frequency@ "of the motion, where parameters follow it";
    input Real displacement(unit = "m");
    input Real velocity(unit = "m/s");
    input Real drive "@drive@";
    discrete output Real force(unit = "N", start = 0, fixed = true);
  protected
    Model model = Model(frequency);
  equation
    when sample(0, samplePeriod) then
      force = step(model, time, displacement, velocity, 0, 0, 0, drive, true);
    end when;
  end SampledDamper;
  annotation(version = "1");
end @name@;
