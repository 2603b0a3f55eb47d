package @name@ "@title@"
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
    input Real drive "A or V";
    input Boolean derive "take slope, acceleration and jerk from the velocity";
    output Real force(unit = "N");
    external "C" force = @name@_external_force(model, instant, displacement, velocity, slope, acceleration, jerk, drive, derive)
      annotation(Include = "#include \"@name@_modelica.h\"",
                 IncludeDirectory = "modelica://@name@/Resources/Include");
  end step;

  block Damper "Force of the damper at every sample of its motion, held in between"
    parameter Real samplePeriod(unit = "s") = 1e-3;
    parameter Real frequency(unit = "Hz") = @frequency@ "of the motion, where parameters follow it";
    input Real displacement(unit = "m");
    input Real velocity(unit = "m/s");
    input Real drive "A or V";
    discrete output Real force(unit = "N", start = 0, fixed = true);
  protected
    Model model = Model(frequency);
  equation
    when sample(0, samplePeriod) then
      force = step(model, time, displacement, velocity, 0, 0, 0, drive, true);
    end when;
  end Damper;
  annotation(version = "1");
end @name@;
